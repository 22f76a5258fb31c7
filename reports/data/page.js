// Draws the page's charts. `glovebench` is for whoever wants to look inside: tables, views by the charts' names, which
// charts had no data, and how long drawing took.

// The rows of a CSV file as the page's tables hold it (RFC 4180): numbers as numbers, empty cells as null.
function parseCsv(text) {
  const lines = [[]];
  for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^",\n]*))(,|\n|$)/g)) {
    const cell = quoted === undefined ? plain : quoted.replaceAll('""', '"');
    const isNumber = quoted === undefined && cell !== '' && Number.isFinite(Number(cell));
    lines[lines.length - 1].push(isNumber ? Number(cell) : cell === '' ? null : cell);
    if (end === '\n') lines.push([]);
    if (end === '') break;
  }
  const heading = lines.shift();
  return lines.filter(line => line.length === heading.length && heading.length > 1 || line[0] !== null)
      .map(line => Object.fromEntries(heading.map((key, i) => [key, line[i]])));
}

async function drawCharts(page) {
  for (const place of document.querySelectorAll('[data-chart]')) {
    const name = place.dataset.chart;
    const [chart, number] = name.split(' ');
    const spec = charts[chart] && charts[chart](page.tables, Number(number));
    if (!spec) {
      page.missing.push(name);
      place.remove();
      continue;
    }
    const drawn = await vegaEmbed(place, {$schema: undefined, config: chartConfig, ...spec}, {
      mode: 'vega-lite', renderer: 'svg', actions: false, tooltip: {theme: 'custom'}
    });
    page.views[name] = drawn.view;
  }
}

const glovebench = {tables: {}, views: {}, missing: [], drawnMs: null};
// Paper has no way to open what is folded.
addEventListener('beforeprint', () => document.querySelectorAll('details').forEach(details => details.open = true));
(async () => {
  const start = performance.now();
  const texts = JSON.parse(document.getElementById('tables').textContent);
  for (const [name, text] of Object.entries(texts)) glovebench.tables[name] = parseCsv(text);
  await drawCharts(glovebench);
  connectFrames(glovebench);
  connectBars(glovebench);
  glovebench.drawnMs = performance.now() - start;
})();
