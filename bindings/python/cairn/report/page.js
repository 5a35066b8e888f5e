// SPDX-License-Identifier: BSD-3-Clause
'use strict';
(function () {
  const data = JSON.parse(document.getElementById('data').textContent);
  const config = {responsive: true, displaylogo: false, displayModeBar: false};
  const sceneDone = data.scene ? drawScene(data.scene, config) : Promise.resolve();
  const curves = data.curves.map((curve, n) =>
    Plotly.newPlot(document.getElementById('curve' + n), curve.data, curve.layout, config));
  // Curves over the same time axis zoom together.
  let zooming = false;
  data.curves.forEach((curve, n) => document.getElementById('curve' + n).on('plotly_relayout', event => {
    if (zooming || curve.alone) return;
    const range = event['xaxis.range[0]'] !== undefined
      ? {'xaxis.range': [event['xaxis.range[0]'], event['xaxis.range[1]']]}
      : event['xaxis.autorange'] ? {'xaxis.autorange': true} : null;
    if (!range) return;
    zooming = true;
    Promise.all(data.curves.map((curve, other) => other === n || curve.alone ? null
      : Plotly.relayout(document.getElementById('curve' + other), range))).then(() => { zooming = false; });
  }));
  Promise.all([sceneDone, ...curves]).then(() => { document.body.dataset.ready = 'true'; });
})();
