// The way to frames: a click on a bar opens those of its experiment. Under the curves of figures 5 and 6, pointing at a
// curve, a keyframe or the slider shows one of them.

function tilePosition(viewer, frame, row) {
  const columns = Number(viewer.dataset.columns);
  const rows = 2 * Math.ceil(Number(viewer.dataset.frames) / columns);
  const share = (place, count) => count < 2 ? 0 : 100 * place / (count - 1);
  return `${share(frame % columns, columns)}% ${share(2 * Math.floor(frame / columns) + row, rows)}%`;
}

const withUnit = (value, unit) => isNumber(value) ? `${value.toFixed(2)} ${unit}` : '–';

function showNumbers(viewer, row) {
  errors.forEach(([name, metric, title, paperColumn], i) => {
    const unit = metric.endsWith('_mm') ? 'mm' : '°';
    const cells = viewer.querySelectorAll('tbody tr')[i].querySelectorAll('td');
    cells[0].textContent = withUnit(row[metric], unit);
    cells[1].textContent = withUnit(row[paperColumn], unit);
  });
}

// Shows the frame of that index in its figure's viewer, curves, slider and keyframes.
function showFrame(page, figure, index) {
  const viewer = document.querySelector(`.frame-viewer[data-figure="${figure}"]`);
  const row = page.tables[figure][index];
  for (const kind of [0, 1])
    viewer.querySelector(`.row-${kind}`).style.backgroundPosition = tilePosition(viewer, index, kind);
  viewer.querySelector('.frame-number').textContent = row.frame;
  const slider = viewer.querySelector('input');
  slider.value = index;
  slider.setAttribute('aria-valuetext', `frame ${row.frame}`);
  showNumbers(viewer, row);
  for (const [name] of errors) page.views[`${figure}-${name}`].signal('frame', row.frame).runAsync();
  for (const key of document.querySelectorAll(`.keyframes[data-figure="${figure}"] button`))
    key.setAttribute('aria-pressed', Number(key.dataset.frame) === index);
}

// The index of the frame over which a pointer is: the drawing may be scaled to fit the page.
function frameAt(page, figure, view, event) {
  const svg = view.container().querySelector('svg');
  const box = svg.getBoundingClientRect();
  const x = (event.clientX - box.left) * Number(svg.getAttribute('width')) / box.width - view.origin()[0];
  const first = page.tables[figure][0].frame;
  const last = Number(document.querySelector(`.frame-viewer[data-figure="${figure}"]`).dataset.frames) - 1;
  return Math.min(Math.max(Math.round(view.scale('x').invert(x)) - first, 0), last);
}

// Once the curves are drawn.
function connectFrames(page) {
  for (const viewer of document.querySelectorAll('.frame-viewer')) {
    const figure = viewer.dataset.figure;
    if (!page.views[`${figure}-position`]) continue;
    viewer.hidden = false;
    for (const [name] of errors) {
      const view = page.views[`${figure}-${name}`];
      const follow = event => showFrame(page, figure, frameAt(page, figure, view, event));
      view.container().addEventListener('pointermove', follow);
      view.container().addEventListener('pointerdown', follow);
    }
    viewer.querySelector('input').addEventListener('input', event => showFrame(page, figure, Number(event.target.value)));
    for (const key of document.querySelectorAll(`.keyframes[data-figure="${figure}"] button`))
      key.addEventListener('click', () => showFrame(page, figure, Number(key.dataset.frame)));
    showFrame(page, figure, 0);
  }
}

function connectBars(page) {
  for (const place of document.querySelectorAll('[data-chart^="figure4-"], [data-chart^="errors-"]')) {
    page.views[place.dataset.chart].addEventListener('click', (event, item) => {
      const frames = item && item.datum && document.getElementById(`frames-${item.datum.experiment}`);
      if (!frames) return;
      frames.open = true;
      location.hash = frames.id;
    });
  }
}
