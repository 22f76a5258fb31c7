'use strict';
// The charts of the pages as Vega-Lite specifications: each is a function of the page's tables (rows of CSV files
// as objects). Colors are the style sheet's variables, so that a chart follows the page between light, dark and paper.

const ours = 'var(--series-0)', paper = 'var(--series-1)';
const seriesColors = ['var(--series-0)', 'var(--series-1)', 'var(--series-2)', 'var(--series-3)'];

const chartConfig = {
  background: 'transparent',
  font: 'system-ui, "DejaVu Sans", sans-serif',
  view: {stroke: null},
  axis: {
    labelColor: 'var(--muted)', titleColor: 'var(--ink)', gridColor: 'var(--rule)', domainColor: 'var(--muted)',
    tickColor: 'var(--muted)', labelFontSize: 12, titleFontSize: 12, titleFontWeight: 600
  },
  axisX: {grid: false, labelFlush: false, tickSize: 4},
  axisY: {domain: false, ticks: false, labelPadding: 6},
  header: {labelColor: 'var(--ink)', labelFontSize: 13, labelFontWeight: 600, titleColor: 'var(--ink)'},
  legend: {
    labelColor: 'var(--ink)', titleColor: 'var(--muted)', labelFontSize: 12, titleFontSize: 12, orient: 'top',
    symbolSize: 90, labelLimit: 320, layout: {top: {direction: 'horizontal', anchor: 'start', margin: 32}}
  },
  title: {color: 'var(--ink)', fontSize: 13},
};

// Grid lines between powers of ten are faint.
const logAxis = {
  format: '~g', tickCount: 5,
  gridOpacity: {
    condition: {test: 'abs(log(datum.value) / LN10 - round(log(datum.value) / LN10)) < 1e-6', value: 1}, value: 0.3
  }
};

const distinct = (rows, key) => [...new Set(rows.map(row => row[key]))];
const isNumber = value => typeof value === 'number';
const withoutPrefix = name => name.replace(/^DB_/, '');

// Means of experiments: a panel for each variant, a group of bars for each trajectory.
const variants = {'recorded 1': 'recorded truth', 'source 1': 'source truth', 'source 2': 'source, second subject'};
const databaseRole = name => ({
  DB_open_pinch: 'of the grasp alone', DB_open_power: 'of the grasp alone', DB_open_pinch_power: 'open, pinch, power',
  DB_20_postures: '20 postures'
})[name] || withoutPrefix(name);
const roleOrder = ['of the grasp alone', 'open, pinch, power', '20 postures'];

function means(table, metric, title, isFirst) {
  return tables => {
    const noises = new Set(tables[table].map(row => `${row.noise} x ${row.noise_factor}`));
    const rows = tables[table].map(row => ({
      experiment: row.experiment, trajectory: row.trajectory, database: row.database,
      role: table === 'figure4' ? databaseRole(row.database) : withoutPrefix(row.database),
      variant: (variants[`${row.truth} ${row.subject}`] || `${row.truth}, subject ${row.subject}`) +
          (noises.size > 1 ? `, ${row.noise} x ${row.noise_factor}` : ''),
      mean: row[`${metric}_mean`], low: row[`${metric}_interval_low`], high: row[`${metric}_interval_high`],
      // The paper's truths are recorded ones.
      paper: row.truth === 'recorded' ? row[`${metric}_paper`] : null
    }));
    const order = Object.values(variants);
    const panels = [...order.filter(variant => rows.some(row => row.variant === variant)),
                    ...distinct(rows, 'variant').filter(variant => !order.includes(variant))];
    const roles = [...roleOrder.filter(role => rows.some(row => row.role === role)),
                   ...distinct(rows, 'role').filter(role => !roleOrder.includes(role))];
    const x = {
      field: 'trajectory', type: 'nominal', sort: null, title: null, axis: {labelAngle: 0, ticks: false}
    };
    const xOffset = {field: 'role', sort: roles};
    const tooltip = [
      {field: 'trajectory'}, {field: 'database'}, {field: 'mean', format: '.2f', title},
      {field: 'low', format: '.2f', title: '95% from'}, {field: 'high', format: '.2f', title: 'to'},
      {field: 'paper', format: '.2f'}
    ];
    const diamonds = {
      transform: [{filter: 'isValid(datum.paper)'}],
      mark: {
        type: 'point', shape: 'diamond', filled: true, size: 80, color: 'var(--ink)', stroke: 'var(--page)',
        strokeWidth: 1, opacity: 1
      },
      encoding: {x, xOffset, tooltip, y: {field: 'paper', type: 'quantitative'}}
    };
    return {
      data: {values: rows},
      facet: {column: {field: 'variant', sort: panels, title: null, header: isFirst ? {} : {labels: false}}},
      spacing: 16,
      spec: {
        width: Math.min(Math.floor(960 / panels.length) - 20, 110 * distinct(rows, 'trajectory').length), height: 140,
        layer: [
          {
            mark: {type: 'bar', cursor: 'pointer'},
            encoding: {
              x, xOffset, tooltip, y: {field: 'mean', type: 'quantitative', title, axis: {minExtent: 30}},
              color: {
                field: 'role', sort: roles, scale: {domain: roles, range: seriesColors},
                legend: isFirst ? {title: 'database'} : null
              }
            }
          },
          {
            mark: {type: 'rule', color: 'var(--ink)', strokeWidth: 1.2},
            encoding: {x, xOffset, y: {field: 'low', type: 'quantitative'}, y2: {field: 'high'}}
          },
          ...(rows.some(row => isNumber(row.paper)) ? [diamonds] : [])
        ]
      }
    };
  };
}

// Figures 5 and 6: one error of the first noise seed frame by frame over the paper's; `frame` marks one of them.
function curve(figure, metric, title, paperColumn, isLast) {
  return tables => {
    const rows = tables[figure].filter(row => row.seed === tables[figure][0].seed);
    const x = {
      field: 'frame', type: 'quantitative', title: isLast ? 'frame' : null,
      scale: {domain: [rows[0].frame, rows[rows.length - 1].frame], nice: false},
      axis: {tickMinStep: 1, labels: isLast, ticks: isLast}
    };
    const y = field => ({field, type: 'quantitative', title, axis: {minExtent: 34, maxExtent: 34, tickCount: 4}});
    const here = [{filter: 'datum.frame === frame'}];
    return {
      data: {values: rows}, width: 640, height: 145, params: [{name: 'frame', value: rows[0].frame}],
      layer: [
        {mark: {type: 'line', color: paper, strokeWidth: 1.5}, encoding: {x, y: y(paperColumn)}},
        {mark: {type: 'line', color: ours, strokeWidth: 1.8}, encoding: {x, y: y(metric)}},
        {transform: here, mark: {type: 'rule', color: 'var(--ink)', strokeDash: [3, 2]}, encoding: {x}},
        {transform: here, mark: {type: 'point', filled: true, color: paper, size: 45}, encoding: {x, y: y(paperColumn)}},
        {transform: here, mark: {type: 'point', filled: true, color: ours, size: 60}, encoding: {x, y: y(metric)}}
      ]
    };
  };
}

// Lines with the intervals of their points, one color and shape a group (`only`: the first group alone). `floor` is
// the column of dashed lines, `groups` those that are drawn.
function lines(table, options) {
  return tables => {
    const {x, y, group, low, high, xTitle, yTitle, xBase, yLog, floor, floorTitle, only, xFormat = 'd'} = options;
    const rows = tables[table].filter(row => isNumber(row[y]) && (!only || row[group] === tables[table][0][group]) &&
                                             (!options.groups || options.groups.includes(row[group])));
    if (rows.length === 0) return null;
    const groups = distinct(rows, group);
    const xs = distinct(rows, x).sort((a, b) => a - b);
    const xEncoding = {
      field: x, type: 'quantitative', title: xTitle, scale: {type: 'log', base: xBase, nice: false},
      axis: {values: xs, format: xFormat}
    };
    const yScale = yLog ? {type: 'log'} : {zero: true};
    const yEncoding = {
      field: y, type: 'quantitative', title: yTitle, scale: yScale, axis: yLog ? logAxis : {}
    };
    const color = {
      field: group, sort: groups, scale: {domain: groups, range: seriesColors}, legend: only ? null : {title: null}
    };
    const shape = {field: group, sort: groups, legend: only ? null : {title: null}};
    const tooltip = [{field: group}, {field: x}, {field: y, format: '.4~g', title: yTitle}];
    const layer = [
      {mark: {type: 'line', strokeWidth: 2}, encoding: {x: xEncoding, y: yEncoding, color}},
      {
        mark: {type: 'point', filled: true, size: 70, opacity: 1},
        encoding: {x: xEncoding, y: yEncoding, color, shape, tooltip}
      }
    ];
    if (low && rows.some(row => isNumber(row[low])))
      layer.push({
        mark: {type: 'rule', strokeWidth: 1.5},
        encoding: {x: xEncoding, y: {field: low, type: 'quantitative'}, y2: {field: high}, color}
      });
    if (floor) {
      const height = {field: floor, aggregate: 'median', type: 'quantitative', scale: yScale};
      layer.push({
        mark: {type: 'line', strokeDash: [5, 4], strokeWidth: 1.5}, encoding: {x: xEncoding, y: height, color}
      }, {
        transform: [{filter: `datum['${x}'] === ${xs[0]}`}],
        mark: {type: 'text', align: 'left', dx: 4, dy: -7, color: 'var(--muted)', text: floorTitle},
        encoding: {x: xEncoding, y: height, detail: {field: group}}
      });
    }
    return {data: {values: rows}, width: options.width || 400, height: 220, layer};
  };
}

// Figure 8: speed against accuracy, ours of each implementation beside the paper's.
function figure8(tables) {
  const rows = tables.figure8;
  const points = rows.filter(row => isNumber(row.frame_ms_p50)).map(row => ({
    database: withoutPrefix(row.database), cascade: row.cascade, who: `glovebench, ${row.implementation}`,
    truth: row.truth, time: row.frame_ms_p50, error: row.posture_error_deg, low: row.posture_error_deg_low,
    high: row.posture_error_deg_high
  }));
  const truths = distinct(points, 'truth');
  // The paper's truths are recorded ones; its points stand beside ours in every row to compare the trade.
  const seen = new Set();
  for (const row of rows) {
    if (!isNumber(row.paper_time_ms) || seen.has(row.database + row.cascade)) continue;
    seen.add(row.database + row.cascade);
    for (const truth of truths)
      points.push({
        database: withoutPrefix(row.database), cascade: row.cascade, who: 'paper (four cores of 2009)', truth,
        time: row.paper_time_ms, error: row.paper_posture_error_deg
      });
  }
  if (points.length === 0) return null;
  const who = distinct(points, 'who'), cascades = distinct(points, 'cascade');
  const x = {
    field: 'time', type: 'quantitative', title: 'time of a frame, median (ms)', scale: {type: 'log', nice: false, padding: 24},
    axis: {...logAxis, grid: true}
  };
  const color = {field: 'who', sort: who, scale: {domain: who, range: seriesColors}, legend: {title: null}};
  const tooltip = [{field: 'who'}, {field: 'cascade'}, {field: 'truth'}, {field: 'time', format: '.3~g'},
                   {field: 'error', format: '.2f'}];
  return {
    data: {values: points},
    facet: {
      column: {field: 'database', title: null, sort: null},
      ...(truths.length > 1 ? {row: {field: 'truth', title: null, sort: truths, header: {labelOrient: 'right', labelAngle: 90}}} : {})
    },
    spacing: 24,
    spec: {
      width: 420, height: 200,
      layer: [
        {
          mark: {type: 'rule', strokeWidth: 1.5},
          encoding: {x, y: {field: 'low', type: 'quantitative'}, y2: {field: 'high'}, color}
        },
        {
          mark: {type: 'point', filled: true, size: 110, opacity: 0.9},
          encoding: {
            x, color, tooltip, y: {field: 'error', type: 'quantitative', title: 'posture error (deg)'},
            shape: {
              field: 'cascade', sort: cascades, legend: {title: 'cascade', symbolFillColor: 'var(--muted)'},
              scale: {domain: cascades, range: ['circle', 'square', 'triangle-up', 'diamond', 'cross', 'triangle-down']}
            }
          }
        }
      ]
    }
  };
}

// What each setting changes against the default of its ablation.
function ablations(change, title, isFirst) {
  return tables => {
    const rows = tables.ablations.filter(row => isNumber(row[change])).map(row => ({
      ...row, name: `${row.ablation}: ${row.setting} (${row.database.replace('DB_', '')})`
    }));
    if (rows.length === 0) return null;
    const names = distinct(rows, 'name');
    const y = {
      field: 'name', type: 'nominal', sort: names, title: null,
      axis: {labels: isFirst, labelLimit: 330, grid: true, ticks: false, labelColor: 'var(--ink)'}
    };
    const color = {value: seriesColors[0]};
    const x = {field: change, type: 'quantitative', title};
    return {
      data: {values: rows}, width: isFirst ? 210 : 230, height: {step: 13},
      layer: [
        {mark: {type: 'rule', color: 'var(--muted)'}, encoding: {x: {datum: 0}}},
        {
          mark: {type: 'rule', strokeWidth: 2},
          encoding: {x: {field: `${change}_low`, type: 'quantitative'}, x2: {field: `${change}_high`}, y, color}
        },
        {
          mark: {type: 'point', filled: true, size: 60, opacity: 1},
          encoding: {
            x, y, color,
            tooltip: [{field: 'name'}, {field: change, format: '+.2f', title}]
          }
        }
      ]
    };
  };
}

// The page of a comparison: candidate - baseline of an experiment frame by frame, a panel for each metric that changed.
function differences(tables, experiment) {
  const rows = tables.differences.filter(row => row.experiment === experiment);
  const metrics = Object.keys(rows[0]).slice(2).filter(metric => rows.some(row => row[metric]));
  const zeroLine = {condition: {test: 'datum.value === 0', value: 'var(--muted)'}, value: 'var(--rule)'};
  return {
    data: {values: rows}, transform: [{fold: metrics, as: ['metric', 'difference']}],
    facet: {row: {field: 'metric', sort: metrics, title: null, header: {labelOrient: 'top', labelAnchor: 'start'}}},
    resolve: {scale: {y: 'independent'}}, spacing: 10,
    spec: {
      width: 760, height: 100, mark: {type: 'line', color: ours, strokeWidth: 1.6, strokeCap: 'round'},
      encoding: {
        x: {
          field: 'frame', type: 'quantitative', axis: {tickMinStep: 1},
          scale: {domain: [rows[0].frame, rows[rows.length - 1].frame], nice: false}
        },
        y: {
          field: 'difference', type: 'quantitative', title: null,
          axis: {minExtent: 34, maxExtent: 34, tickCount: 4, gridColor: zeroLine}
        }
      }
    }
  };
}

// The page of settings: each error against the time of a frame, a panel for each quantity.
function settings(tables) {
  const times = new Map(
      tables.settings.filter(row => row.quantity === 'time_ms').map(row => [row.setting, row.mean]));
  const points = tables.settings.filter(row => row.quantity !== 'time_ms' && isNumber(row.mean) &&
                                               isNumber(times.get(row.setting)))
                     .map(row => ({...row, time: times.get(row.setting)}));
  if (points.length === 0) return null;
  const names = distinct(points, 'setting');
  return {
    data: {values: points}, columns: 3, spacing: 24, resolve: {scale: {y: 'independent'}},
    facet: {field: 'quantity', sort: distinct(points, 'quantity'), title: null},
    spec: {
      width: 230, height: 150, mark: {type: 'point', filled: true, size: 110, opacity: 0.9},
      encoding: {
        x: {field: 'time', type: 'quantitative', title: 'time of a frame, median (ms)', axis: {tickCount: 5}},
        y: {
          field: 'mean', type: 'quantitative', title: null,
          axis: {tickCount: 4, minExtent: 34, maxExtent: 34, format: '~g'}
        },
        color: {field: 'setting', sort: names, scale: {domain: names, range: seriesColors}, legend: {title: null}},
        shape: {field: 'setting', sort: names, legend: {title: null}},
        tooltip: [{field: 'setting'}, {field: 'mean', format: '.3~f'}, {field: 'time', format: '.3~f', title: 'ms'},
                  {field: 'verdict'}]
      }
    }
  };
}

// The page of `track`: columns over time, a panel for each group, a line for each column.
function track(panelOf, lineOf, title, width) {
  return tables => {
    const start = tables.track[0].timestamp_us;
    const rows = tables.track.map(row => ({...row, time: (row.timestamp_us - start) / 1e6}));
    const columns = Object.keys(rows[0]).filter(key => panelOf(key));
    const values = columns.flatMap(column => rows.map(
        row => ({time: row.time, frame: row.frame, value: row[column], panel: panelOf(column), line: lineOf(column)})));
    const names = distinct(values, 'line');
    return {
      data: {values}, spacing: 10, resolve: {scale: {y: 'independent'}},
      facet: {row: {field: 'panel', sort: distinct(values, 'panel'), title: null, header: {labelOrient: 'top', labelAnchor: 'start'}}},
      spec: {
        width, height: 110, mark: {type: 'line', strokeWidth: 1.6},
        encoding: {
          x: {field: 'time', type: 'quantitative', title: 'time (s)'},
          y: {field: 'value', type: 'quantitative', title, scale: {zero: false}, axis: {minExtent: 34, tickCount: 4, format: '~f'}},
          color: {field: 'line', sort: names, scale: {domain: names, range: seriesColors}, legend: names.length > 1 ? {title: null} : null}
        }
      }
    };
  };
}

const angleKind = key => /abduction/.test(key)                 ? 'abduction'
                         : /_dip_|thumb_ip_/.test(key)        ? 'flexion of the end joint (DIP, IP)'
                         : /_pip_|thumb_mcp_/.test(key)       ? 'flexion of the middle joint (PIP, thumb MCP)'
                                                              : 'flexion of the base joint (MCP, thumb CMC, wrist)';

const errors = [['position', 'position_error_mm', 'Position error (mm)', 'paper_position_error_mm'],
                ['posture', 'posture_rms_deg', 'Posture error (deg)', 'paper_posture_error_deg'],
                ['rotation', 'rotation_error_deg', 'Rotation error (deg)', 'paper_rotation_error_deg']];

const charts = {};
errors.forEach(([name, metric, title, paperColumn], i) => {
  for (const table of ['figure4', 'errors'])
    charts[`${table}-${name}`] = means(table, metric, title, i === 0);
  for (const figure of ['figure5', 'figure6'])
    charts[`${figure}-${name}`] = curve(figure, metric, title, paperColumn, i === errors.length - 1);
});
const size = {x: 'size_px', group: 'implementation', xTitle: 'tiny image (pixels a side)', xBase: 2, yLog: true};
charts['figure7-time'] = lines('figure7', {...size, y: 'distance_us', yTitle: 'time of one distance (µs)'});
charts['figure7-rank'] = lines('figure7', {
  ...size, only: true, y: 'mean_rank', low: 'mean_rank_low', high: 'mean_rank_high', yTitle: 'mean rank of the true neighbor'
});
charts['figure8'] = figure8;
charts['differences'] = differences;
charts['settings'] = settings;
charts['track-position'] = track(key => (key.match(/^position_(.)_mm$/) || [])[1], () => 'position', 'mm', 760);
charts['track-angles'] = track(key => (key.match(/^([a-z]+)_.*_deg$/) || [])[1],
                               angleKind, 'deg', 760);
const factor = {x: 'factor', group: 'database', xTitle: 'sub-sampling factor', xBase: 2, width: 260};
charts['figure9-position'] = lines('figure9', {
  ...factor, y: 'position_error_mm', low: 'position_error_mm_low', high: 'position_error_mm_high',
  yTitle: 'position error (mm)'
});
charts['figure9-rotation'] = lines('figure9', {
  ...factor, y: 'rotation_error_deg', low: 'rotation_error_deg_low', high: 'rotation_error_deg_high',
  yTitle: 'rotation error (deg)'
});
charts['figure9-time'] = lines('figure9_times', {
  ...factor, group: 'implementation', y: 'frame_ms_p50', yTitle: 'time of a frame, median (ms)', yLog: true,
  floor: 'look_up_ms_p50', floorTitle: 'look-up'
});
[['position', 'position_change_mm', 'position error (mm)'], ['posture', 'posture_change_deg', 'posture error (deg)'],
 ['rotation', 'rotation_change_deg', 'rotation error (deg)']].forEach(([name, change, title], i) => {
  charts[`ablations-${name}`] = ablations(change, `change of the ${title}`, i === 0);
});
[['light-strength', 'light_strength', 'strength', 'strength of the light (1: the default)'],
 ['light-temperature', 'light_temperature', 'temperature_k', 'color temperature (K)'],
 ['light-white-balance', 'light_white_balance', 'green_gain', 'gain of green against red and blue']]
    .forEach(([name, table, x, xTitle]) => {
  charts[name] = lines(table, {
    x, group: 'labels', xTitle, xBase: 2, xFormat: '~g', y: 'not_right_percent', yTitle: 'glove pixels not right (%)',
    yLog: true, width: 560,
    groups: ['own table', 'own table, surface majority', 'recalibrated', 'recalibrated, surface majority']
  });
});
