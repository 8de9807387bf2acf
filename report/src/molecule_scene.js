// SPDX-License-Identifier: BSD-3-Clause
// The molecule in 3D, drawn by 3Dmol.js.
import {GLDraw} from '3dmol/src/GLDraw.ts';
import {GLViewer} from '3dmol/src/GLViewer.ts';
import {Color} from '3dmol/src/colors.ts';
import {html, wants_stillness} from './dom.js';
import {main_axes, nearest_pair, quaternion_of, trace_of} from './geometry.js';
import {clash_color, make_painter} from './molecule_style.js';
import {make_atoms} from './molecule_atoms.js';
import {positions_of} from './report.js';
import {choice, toggle} from './view.js';
import {fixed} from './words.js';

const camera_z = 150, half_view = Math.PI / 18;  // of 3Dmol's camera: distance at zoom 0, half of its angle of view
const most_clashes = 2000;                       // drawn in one frame
const fixed_part = 0.1;                          // least part of fixed atoms for which the two parts are coloured
const in_front = 7, behind = 40;                 // angstrom: depth that the camera shows around a selected pair
const neighbourhood = 6;                         // angstrom around a selected pair that the camera shows

/** True if the browser draws without a graphics card: four times the pixels would take a second then. */
function draws_in_software() {
  const gl = document.createElement('canvas').getContext('webgl');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

function largest_overlap(report) {
  let most = 0.4;
  for (const frame of report.frames) for (const pair of frame.pairs) most = Math.max(most, pair.overlap ?? 0);
  return most;
}

/** Draws a disc between the atoms of each colliding pair, and a thin rod from atom to atom. Beside a selected pair, the
 * others are rods only. */
function draw_clashes(viewer, pairs, point, most, selected) {
  const shape = viewer.addShape({});
  shape.color = undefined;  // each disc has its own
  for (const pair of pairs.slice(0, most_clashes)) {
    const [p, q] = [point(pair.a), point(pair.b)];
    const part = pair.overlap === null ? 0.5 : Math.max(0, Math.min(1, pair.overlap / most));
    const [r, g, b] = clash_color(pair.collides ? part : null);
    const color = new Color(r, g, b);
    GLDraw.drawCylinder(shape.geo, p, q, pair.collides && !(selected && pair !== selected) ? 0.1 + 0.06 * part : 0.06, color);
    if (!pair.collides || (selected && pair !== selected)) continue;
    const length = Math.hypot(p.x - q.x, p.y - q.y, p.z - q.z) || 1;
    const at = (t) => ({x: p.x + t * (q.x - p.x), y: p.y + t * (q.y - p.y), z: p.z + t * (q.z - p.z)});
    const half = Math.min(0.12, 0.2 * length) / length;
    GLDraw.drawCylinder(shape.geo, at(0.5 - half), at(0.5 + half), 0.3 + 0.45 * part, color, 1, 1);
  }
}

function make_legend(most, has_moving) {
  const swatch = (name, text) => html('span', {class: 'swatch-item'}, html('i', {class: `swatch ${name}`}), text);
  return [
    ...(most === 0 ? [] : [html('span', {class: 'swatch-item'}, 'Overlap 0', html('i', {class: 'swatch swatch-ramp'}),
         `${fixed(most, 1)} \u00c5`)]),
    ...(has_moving ? [swatch('swatch-moving', 'moving'), swatch('swatch-fixed', 'fixed')] : []),
  ];
}

/** Returns a scene of the molecule; view.js says what a scene is. */
export function make_molecule_scene(box, report, {store, dark, on_change}) {
  const {molecule} = report;
  const viewer = new GLViewer(box, {
    backgroundColor: dark ? '#141a22' : '#ffffff', antialias: true, cartoonQuality: molecule.names.length > 4000 ? 5 : 8,
    disableFog: false, upscale: !draws_in_software(),
  });
  const model = viewer.addModel();
  let positions = positions_of(molecule, report.frames[store.state.frame]);
  model.addAtoms(make_atoms(molecule, positions));
  const atoms = model.selectedAtoms({});
  const painter = make_painter(report, atoms);
  const most = largest_overlap(report);
  const fixed_atoms = molecule.moving.reduce((count, moves) => count + (moves === 0 ? 1 : 0), 0);
  const some_move = fixed_atoms > fixed_part * atoms.length && fixed_atoms < atoms.length;
  const look = {style: painter.has_cartoon ? 'cartoon' : 'sticks', moving: some_move};
  const point = (i) => ({x: positions[3 * i], y: positions[3 * i + 1], z: positions[3 * i + 2]});
  let drawn = null, depth = null;

  const move_atoms = (frame) => {
    positions = positions_of(molecule, report.frames[frame]);
    atoms.forEach((atom, i) => Object.assign(atom, point(i)));
  };
  const draw = () => {
    const {frame, selected} = store.state;
    if (drawn !== frame) move_atoms(frame);
    drawn = frame;
    const {pairs} = report.frames[frame];
    painter.paint(look, pairs, selected);
    model.molObj = null;
    viewer.removeAllShapes();
    draw_clashes(viewer, selected && !pairs.slice(0, most_clashes).includes(selected) ? [selected, ...pairs] : pairs,
                 point, most, selected);
    if (!selected && depth) viewer.setSlab(depth.near, depth.far);
    viewer.render();
  };

  const whole_view = () => {
    const trace = trace_of(molecule);
    const chosen = trace.length > 2 ? trace : atoms.map((_, i) => i);
    const axes = main_axes(chosen.flatMap((i) => Array.from(positions.subarray(3 * i, 3 * i + 3))));
    viewer.setView([0, 0, 0, 0, ...quaternion_of(axes)]);
    viewer.zoomTo();
    viewer.zoom(box.clientWidth > box.clientHeight ? 1.25 : 1);
    depth = viewer.getSlab();
  };

  /** Returns the pixel and the distance from the camera of a point. */
  const seen = ({x, y, z}) => {
    const m = viewer.modelGroup.matrixWorld.elements;
    const away = camera_z - (m[2] * x + m[6] * y + m[10] * z + m[14]);
    const scale = box.clientHeight / 2 / Math.tan(half_view) / away;
    return [box.clientWidth / 2 + scale * (m[0] * x + m[4] * y + m[8] * z + m[12]),
            box.clientHeight / 2 - scale * (m[1] * x + m[5] * y + m[9] * z + m[13]), away];
  };
  const middle = (pair) => {
    const [p, q] = [point(pair.a), point(pair.b)];
    return {x: (p.x + q.x) / 2, y: (p.y + q.y) / 2, z: (p.z + q.z) / 2};
  };

  whole_view();  // before anything is drawn: each of its steps renders the scene
  viewer.setViewChangeCallback(on_change);
  draw();

  return {
    show: draw,
    focus(pair, animated) {
      const {x, y, z} = middle(pair);
      const near = atoms.filter((a) => Math.hypot(a.x - x, a.y - y, a.z - z) < neighbourhood).map((a) => a.index);
      viewer.zoomTo({index: [...new Set([...near, pair.a, pair.b])]},
                    animated && !wants_stillness() ? 400 : 0);
      viewer.setSlab(-in_front, behind);
    },
    reset: whole_view,
    set_dark(now) { viewer.setBackgroundColor(now ? '#141a22' : '#ffffff'); },
    anchors: (pair) => [point(pair.a), point(pair.b)],
    project: (p) => seen(p).slice(0, 2),
    pick: (px, py, within) => nearest_pair(report.frames[store.state.frame].pairs, (pair) => seen(middle(pair)), px, py,
                                           within),
    hover(px, py) {
      let best = -1, least = Infinity;
      atoms.forEach((atom, i) => {
        if (!painter.is_visible(atom)) return;
        const [x, y, away] = seen(atom);
        if (Math.hypot(x - px, y - py) < 7 && away < least) [best, least] = [i, away];
      });
      return best < 0 ? null : report.labels[best];
    },
    camera: () => viewer.getView(),
    controls: [
      choice('Style', painter.has_cartoon ? ['Cartoon', 'Sticks', 'Spheres'] : ['Sticks', 'Spheres'], 0, (k) => {
        look.style = (painter.has_cartoon ? ['cartoon', 'sticks', 'spheres'] : ['sticks', 'spheres'])[k];
        draw();
      }),
      ...(some_move ? [toggle('Colour moving part', true, (on) => {
        look.moving = on;
        draw();
      })] : []),
    ],
    legend: make_legend(report.all.collides.includes(1) ? most : 0, some_move),
  };
}
