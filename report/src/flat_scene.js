// SPDX-License-Identifier: BSD-3-Clause
// The picture without WebGL: lines in SVG, seen along one of three directions.
import {html, svg} from './dom.js';
import {main_axes, nearest_pair, sharp_edges, trace_lines} from './geometry.js';
import {placed, pose_of, positions_of} from './report.js';
import {choice} from './view.js';

const most_rows = 2000, most_lines = 60000, margin = 0.06;

function molecule_drawing(report) {
  const {molecule} = report;
  const {bonds} = molecule;
  let positions = null;
  const at = (i) => [positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]];
  const near_pairs = (pairs) => {
    const residues = new Set(pairs.flatMap((pair) => [molecule.of_atom[pair.a], molecule.of_atom[pair.b]]));
    const lines = [];
    for (let k = 0; k < bonds.length; k += 2)
      if (residues.has(molecule.of_atom[bonds[k]]) || residues.has(molecule.of_atom[bonds[k + 1]]))
        lines.push([bonds[k], bonds[k + 1]]);
    return lines;
  };
  return {
    place(frame) { positions = positions_of(molecule, report.frames[frame]); },
    points: () => positions,
    groups(frame, selected) {
      let trace = trace_lines(molecule, positions);
      if (trace.length < 2) trace = Array.from({length: bonds.length / 2}, (_, k) => [bonds[2 * k], bonds[2 * k + 1]]);
      const moves = ([i, j]) => molecule.moving[i] === 1 && molecule.moving[j] === 1;
      const ends = (lines) => lines.slice(0, most_lines).map(([i, j]) => [at(i), at(j)]);
      const pairs = report.frames[frame].pairs.filter((pair) => pair.collides || pair === selected);
      return [['flat-fixed', ends(trace.filter((line) => !moves(line)))],
              ['flat-moving', ends(trace.filter(moves))], ['flat-bonds', ends(near_pairs(pairs))]];
    },
    anchors: (pair) => [at(pair.a), at(pair.b)],
    axes: () => main_axes(positions),
  };
}

function robot_drawing(report) {
  const {robot} = report;
  const parts = [...robot.links, ...robot.bodies];
  const edges = parts.map(sharp_edges);
  let poses = null;
  const point = (k, v) => placed(poses[k], ...parts[k].vertices.subarray(3 * v, 3 * v + 3));
  const center = (k) => {
    const n = parts[k].vertices.length / 3;
    if (n === 0) return placed(poses[k], 0, 0, 0);
    const sum = [0, 0, 0];
    for (let v = 0; v < n; ++v) point(k, v).forEach((x, c) => { sum[c] += x / n; });
    return sum;
  };
  return {
    place(frame) { poses = parts.map((_, k) => pose_of(robot, report.frames[frame], k)); },
    points: () => Float32Array.from(robot.links.flatMap((link, k) =>
      Array.from({length: link.vertices.length / 3}, (_, v) => point(k, v)).flat())),
    groups(frame, selected) {
      const colliding = new Set(report.frames[frame].pairs.filter((pair) => pair.collides)
        .flatMap((pair) => [pair.a, pair.b]));
      const of_part = (k) => (selected ? (selected.a === k || selected.b === k ? 'flat-collides' : 'flat-fixed')
                            : colliding.has(k) ? 'flat-collides' : k < robot.links.length ? 'flat-moving' : 'flat-body');
      return parts.map((_, k) => [of_part(k), edges[k].map(([i, j]) => [point(k, i), point(k, j)])]);
    },
    anchors: (pair) => pair.points ?? [center(pair.a), center(pair.b)],
    axes: () => [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  };
}

/** Returns a scene without WebGL; view.js says what a scene is. */
export function make_flat_scene(box, report, {store, on_change}) {
  const drawing = report.is_robot ? robot_drawing(report) : molecule_drawing(report);
  const picture = svg('svg', {class: 'flat', preserveAspectRatio: 'xMidYMid meet', 'aria-hidden': 'true'});
  box.append(picture);
  drawing.place(store.state.frame);
  const [x, y, z] = drawing.axes();
  const opposite = z.map((c) => -c);
  const sides = [[x, y], [opposite, y], [x, opposite]];
  const view = {side: 0, middle: [0, 0], half: 1};

  const flat = (p) => sides[view.side].map((axis, k) => (k === 0 ? 1 : -1) *
                                                       (axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2]));
  const project = (p) => {
    const [u, v] = flat(p);
    const scale = Math.min(box.clientWidth, box.clientHeight) / 2 / view.half;
    return [box.clientWidth / 2 + scale * (u - view.middle[0]), box.clientHeight / 2 + scale * (v - view.middle[1])];
  };
  const set_window = () => {
    picture.setAttribute('viewBox', [view.middle[0] - view.half, view.middle[1] - view.half, 2 * view.half,
                                     2 * view.half].map((c) => c.toPrecision(7)).join(' '));
    on_change();
  };
  const whole_view = () => {
    const points = drawing.points();
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (let k = 0; k + 2 < points.length; k += 3)
      flat(points.subarray(k, k + 3)).forEach((c, axis) => {
        low[axis] = Math.min(low[axis], c);
        high[axis] = Math.max(high[axis], c);
      });
    if (!Number.isFinite(low[0])) return;
    view.middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    view.half = Math.max(1e-6, (high[0] - low[0]) / 2, (high[1] - low[1]) / 2) * (1 + 2 * margin);
    set_window();
  };
  const number = (c) => String(Number(c.toPrecision(6)));
  const draw = (state) => {
    drawing.place(state.frame);
    const lines = drawing.groups(state.frame, state.selected).map(([name, ends]) => svg('path', {
      class: name, fill: 'none', 'vector-effect': 'non-scaling-stroke',
      d: ends.map(([p, q]) => `M${flat(p).map(number).join(' ')}L${flat(q).map(number).join(' ')}`).join(''),
    }));
    const pairs = report.frames[state.frame].pairs.filter((pair) => pair.collides || pair === state.selected);
    const marks = pairs.slice(0, most_rows).map((pair) => svg('path', {
      class: pair === state.selected ? 'flat-mark flat-chosen' : 'flat-mark', 'vector-effect': 'non-scaling-stroke',
      d: drawing.anchors(pair).map((p, k) => `${k === 0 ? 'M' : 'L'}${flat(p).map(number).join(' ')}`).join('') + 'h0',
    }));
    picture.replaceChildren(...lines, ...marks);
  };
  const middle = (pair) => {
    const [p, q] = drawing.anchors(pair);
    return p.map((c, k) => (c + q[k]) / 2);
  };
  draw(store.state);
  whole_view();
  new ResizeObserver(on_change).observe(box);

  return {
    show: draw,
    focus(pair) {
      const whole = view.half;
      whole_view();
      view.half = Math.min(whole, view.half * 0.35);
      view.middle = flat(middle(pair));
      set_window();
    },
    reset: whole_view,
    set_dark() {},
    anchors: drawing.anchors,
    project,
    pick: (px, py, within) => nearest_pair(report.frames[store.state.frame].pairs, (pair) => project(middle(pair)), px,
                                           py, within),
    hover: () => null,
    camera: () => [view.side, ...view.middle, view.half],
    controls: [choice('Side', ['Front', 'Side', 'Top'], 0, (k) => {
      view.side = k;
      draw(store.state);
      whole_view();
    })],
    legend: [html('span', {}, 'Drawn with lines, because this browser has no WebGL.')],
  };
}
