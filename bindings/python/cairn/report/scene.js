// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// Draws the 3-D scene and handles its slider. The promise resolves when the scene is drawn.
function drawScene(scene, config) {
  const sceneConfig = {...config, displayModeBar: true,
                       modeBarButtons: [['orbitRotation', 'pan3d', 'zoom3d', 'resetCameraDefault3d']]};
  const compared = scene.runs.length > 1;
  const colours = {only: '#2563a8', standard: '#c8641b', submaps: '#2563a8'};
  const main = scene.runs[scene.runs.length - 1];
  const plot = document.getElementById('scene');
  const traces = [], dynamic = [];  // dynamic: [number of a trace, function of a stop that returns what to set]

  // Number of entries of an ascending list that are at most `step`.
  function known(steps, step) {
    let low = 0, high = steps.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (steps[middle] <= step) low = middle + 1; else high = middle;
    }
    return low;
  }
  const cut = (points, count) => ({x: points.x.slice(0, count), y: points.y.slice(0, count), z: points.z.slice(0, count)});
  function add(trace, update) {
    traces.push(trace);
    if (update) dynamic.push([traces.length - 1, update]);
  }

  if (scene.terrain) {
    add({type: 'surface', x: scene.terrain.x, y: scene.terrain.y, z: scene.terrain.z, name: 'terrain', showscale: false,
         colorscale: [[0, '#c9a27e'], [0.5, '#dfc3a3'], [1, '#f2e4cf']], opacity: 0.62, hoverinfo: 'skip', showlegend: true,
         lighting: {ambient: 0.72, diffuse: 0.5, specular: 0.02, roughness: 0.95}});
  }
  const truthOf = scene.runs.find(run => run.truth);
  if (truthOf) {
    add({type: 'scatter3d', mode: 'lines', ...truthOf.truth, name: 'true trajectory', hoverinfo: 'skip',
         line: {color: '#1c1b19', width: 3}});
  }
  scene.runs.forEach(run => {
    const colour = compared ? colours[run.name] : colours.only, suffix = compared ? ' (' + run.name + ')' : '';
    const visible = run === main ? true : 'legendonly';
    add({type: 'scatter3d', mode: 'lines', ...run.estimate, name: 'estimated trajectory' + suffix,
         line: {color: colour, width: 5}, hovertemplate: '%{x:.2f}, %{y:.2f}, %{z:.2f} m<extra></extra>'},
        stop => cut(run.estimate, known(run.steps, stop.step)));
    if (run.landmarks.x.length) {
      add({type: 'scatter3d', mode: 'markers', ...run.landmarks, name: 'landmarks' + suffix, visible,
           marker: {size: run.landmarks.x.length > 3000 ? 1.6 : 2.6, color: colour, opacity: 0.85}, text: run.landmarks.id,
           hovertemplate: 'landmark %{text}<br>%{x:.2f}, %{y:.2f}, %{z:.2f} m<extra></extra>'},
          stop => cut(run.landmarks, known(run.landmarks.step, stop.step)));
    }
    if (run.ellipsoids) {
      const faces = run.ellipsoids.faces, each = run.ellipsoids.facesEach;
      add({type: 'mesh3d', x: run.ellipsoids.x, y: run.ellipsoids.y, z: run.ellipsoids.z, i: faces[0], j: faces[1],
           k: faces[2], color: colour, opacity: 0.28, name: '3σ ellipsoids' + suffix, showlegend: true, visible,
           hoverinfo: 'skip', flatshading: false},
          stop => {
            const count = each * known(run.ellipsoids.step, stop.step);
            return {i: faces[0].slice(0, count), j: faces[1].slice(0, count), k: faces[2].slice(0, count)};
          });
    }
  });
  if (main.trueLandmarks) {
    add({type: 'scatter3d', mode: 'markers', ...main.trueLandmarks, name: 'true landmarks', visible: 'legendonly',
         marker: {size: 2.6, symbol: 'x', color: '#55524a'}, hoverinfo: 'skip'});
  }

  if (main.outlines) {
    const palette = ['#2563a8', '#7a4fb5', '#1d8a7a', '#b5487e', '#5b7f1e', '#a86a12'];
    const all = {x: [], y: [], z: [], colour: [], ends: [], steps: []};
    main.outlines.forEach((outline, n) => {
      for (let i = 0; i < outline.x.length; ++i) {
        for (const axis of 'xyz') all[axis].push(outline[axis][i]);
        all.colour.push(palette[n % palette.length]);
      }
      for (const axis of 'xyz') all[axis].push(null);
      all.colour.push(palette[n % palette.length]);
      all.ends.push(all.x.length);
      all.steps.push(outline.step);
    });
    add({type: 'scatter3d', mode: 'lines', x: all.x, y: all.y, z: all.z, name: 'submaps', hoverinfo: 'skip',
         line: {width: 2.5, color: all.colour}},
        stop => {
          const count = known(all.steps, stop.step), end = count ? all.ends[count - 1] : 0;
          return {...cut(all, end), 'line.color': all.colour.slice(0, end)};
        });
    const lastClosed = stop => main.outlines[known(all.steps, stop.step) - 1];
    add({type: 'scatter3d', mode: 'lines', x: [], y: [], z: [], name: 'submap closed last', hoverinfo: 'skip',
         line: {width: 7, color: '#b3261e'}},
        stop => lastClosed(stop) ? cut(lastClosed(stop), Infinity) : {x: [], y: [], z: []});
    add({type: 'scatter3d', mode: 'markers', x: [], y: [], z: [], name: 'its landmarks', hoverinfo: 'skip',
         marker: {size: 3.6, color: '#b3261e'}},
        stop => {
          const rows = lastClosed(stop) ? lastClosed(stop).landmarks : [];
          return {x: rows.map(i => main.landmarks.x[i]), y: rows.map(i => main.landmarks.y[i]),
                  z: rows.map(i => main.landmarks.z[i])};
        });
  }
  add({type: 'scatter3d', mode: 'markers', x: [], y: [], z: [], name: 'vehicle', hoverinfo: 'skip', showlegend: false,
       marker: {size: 6, symbol: 'diamond', color: '#b3261e', line: {color: '#fff', width: 1}}},
      stop => {
        const i = Math.max(known(main.steps, stop.step) - 1, 0);
        return {x: [main.estimate.x[i]], y: [main.estimate.y[i]], z: [main.estimate.z[i]]};
      });

  const narrow = window.innerWidth < 700, away = narrow ? 1.5 : 1;
  const axis = title => ({title: {text: title}, backgroundcolor: '#fbfaf7', showbackground: true, gridcolor: '#e2dfd7',
                          zerolinecolor: '#d4d0c6', color: '#6d6a62'});
  const layout = {
    margin: {l: 0, r: 0, t: 0, b: 0}, paper_bgcolor: '#ffffff', uirevision: 'kept',
    font: {family: 'system-ui, sans-serif', size: 12, color: '#33312c'},
    legend: {...(narrow ? {orientation: 'h', x: 0, y: 0.3, yanchor: 'top'} : {x: 0, y: 1}), bgcolor: 'rgba(255,255,255,0.82)', bordercolor: '#e4e1da', borderwidth: 1, itemsizing: 'constant'},
    scene: {domain: narrow ? {x: [0, 1], y: [0.32, 1]} : {x: [0.1, 1], y: [0, 1]}, xaxis: axis('x (m)'), yaxis: axis('y (m)'), zaxis: axis('z (m)'), aspectmode: 'manual',
            aspectratio: {x: scene.aspect.x, y: scene.aspect.y, z: scene.aspect.z},
            camera: {eye: {x: -0.8 * away, y: -1.08 * away, z: 0.9 * away}, center: {x: 0, y: 0, z: -0.14}}}
  };

  const slider = document.getElementById('slider'), label = document.getElementById('stop');
  const play = document.getElementById('play');
  let drawing = Promise.resolve(), wanted = null, timer = null;

  function describe(stop) {
    const parts = ['step ' + stop.step + (stop.time === null ? '' : ', ' + stop.time.toFixed(1) + ' s')];
    if (main.outlines) parts.push(stop.submaps + (stop.submaps === 1 ? ' submap' : ' submaps'));
    if (main.landmarks.x.length) parts.push(stop.landmarks + ' landmarks seen');
    return parts.join(' · ');
  }
  // Draws the newest requested stop. Requests that came while it was drawing are skipped.
  function show(number) {
    label.textContent = describe(scene.stops[number]);
    const idle = wanted === null;
    wanted = number;
    if (!idle) return drawing;
    drawing = drawing.then(function next() {
      const stop = scene.stops[wanted], drawn = wanted, numbers = [], changes = {};
      dynamic.forEach(([number, update]) => {
        for (const [key, value] of Object.entries(update(stop))) {
          (changes[key] = changes[key] || {})[number] = value;
        }
        numbers.push(number);
      });
      return draw(changes, numbers).then(() => {
        if (wanted !== drawn) return next();
        wanted = null;
        document.body.dataset.stop = String(drawn);
      });
    });
    return drawing;
  }
  // One restyle call for each set of keys that the same traces share.
  function draw(changes, numbers) {
    const groups = {};
    numbers.forEach(number => {
      const keys = Object.keys(changes).filter(key => number in changes[key]).join('|');
      (groups[keys] = groups[keys] || []).push(number);
    });
    return Object.entries(groups).reduce((before, [keys, members]) => before.then(() => {
      const update = {};
      keys.split('|').forEach(key => { update[key] = members.map(number => changes[key][number]); });
      return Plotly.restyle(plot, update, members);
    }), Promise.resolve());
  }
  function pause() { clearInterval(timer); timer = null; play.textContent = '▶'; }
  play.addEventListener('click', () => {
    if (timer) return pause();
    if (+slider.value >= +slider.max) slider.value = 0;
    play.textContent = '❚❚';
    timer = setInterval(() => {
      if (+slider.value >= +slider.max) return pause();
      if (wanted !== null) return;
      slider.value = +slider.value + 1;
      show(+slider.value);
    }, 120);
  });
  slider.max = scene.stops.length - 1;
  slider.value = slider.max;
  slider.addEventListener('input', () => { pause(); show(+slider.value); });

  const webgl = (() => {
    try { return !!document.createElement('canvas').getContext('webgl'); } catch (error) { return false; }
  })();
  const notes = [];
  const counts = main.counts;
  if (counts.landmarksDrawn < counts.landmarks) {
    notes.push(counts.landmarksDrawn + ' of ' + counts.landmarks + ' landmarks are drawn, evenly chosen.');
  }
  if (counts.ellipsoids) {
    notes.push(counts.ellipsoids < counts.landmarks
      ? 'Ellipsoids (3σ along each axis) are drawn for ' + counts.ellipsoids + ' of ' + counts.landmarks +
        ' landmarks: the most uncertain ones, and evenly chosen others.'
      : 'Ellipsoids are 3σ along each axis.');
  }
  if (counts.submaps) {
    notes.push('A submap’s outline is the hull of its landmarks.' + (main.outlines.length < counts.submaps
      ? ' ' + main.outlines.length + ' of ' + counts.submaps + ' are drawn.' : ''));
  }
  if (scene.aspect.times > 1) notes.push('Heights are drawn ' + scene.aspect.times + ' times as tall as they are.');
  notes.push('The map is as it was known at the end of the run; the slider shows what of it had been seen.');
  const sceneDone = webgl ? Plotly.newPlot(plot, traces, layout, sceneConfig).then(() => show(+slider.value)) : Promise.resolve();
  if (!webgl) notes.unshift('This browser has no WebGL, which the 3-D scene takes.');
  document.getElementById('scene-note').textContent = notes.join(' ');
  return sceneDone;
}
