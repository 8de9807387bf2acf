// SPDX-License-Identifier: BSD-3-Clause
// The robot and the bodies around it in 3D, drawn by three.js.
import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, CylinderGeometry, DirectionalLight, DoubleSide, GridHelper, Mesh,
  MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Quaternion, Raycaster, Scene, SphereGeometry, Vector2,
  Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {html, wants_stillness} from './dom.js';
import {creased, nearest_pair} from './geometry.js';
import {pose_of} from './report.js';
import {toggle} from './view.js';

const colors = {link: 0x9fb2c9, fixed: 0x7d8896, body: 0xc9b184, colliding: 0xe0308a, first: 0xd6246f, second: 0xf2a623,
                contact: 0xffd23c};
const background = {light: 0xffffff, dark: 0x141a22};
const most_contacts = 300;  // drawn in one configuration

function geometry_of(mesh) {
  const {positions, normals} = creased(mesh);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  geometry.computeBoundingBox();
  return geometry;
}

function mesh_of(part) {
  const material = new MeshStandardMaterial({side: DoubleSide, roughness: 0.62, metalness: 0.05});
  const mesh = new Mesh(geometry_of(part), material);
  mesh.matrixAutoUpdate = false;
  return mesh;
}

function swatch(name, text) {
  return html('span', {class: 'swatch-item'}, html('i', {class: `swatch ${name}`}), text);
}

/** Returns the spheres and rods that mark where two parts touch or are closest. */
function make_contacts(scene) {
  const ball = new SphereGeometry(1, 16, 12), rod = new CylinderGeometry(1, 1, 1, 12);
  const material = new MeshBasicMaterial({color: colors.contact, depthTest: false, transparent: true});
  const drawn = [];
  const add = (geometry) => {
    const mesh = new Mesh(geometry, material);
    mesh.renderOrder = 4;
    scene.add(mesh);
    drawn.push(mesh);
    return mesh;
  };
  return {
    clear() {
      for (const mesh of drawn.splice(0)) scene.remove(mesh);
    },
    add([p, q], radius) {
      for (const end of [p, q]) {
        const mesh = add(ball);
        mesh.position.copy(end);
        mesh.scale.setScalar(radius);
      }
      const along = q.clone().sub(p);
      const length = along.length();
      if (length < radius) return;
      const mesh = add(rod);
      mesh.position.copy(p).addScaledVector(along, 0.5);
      mesh.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), along.divideScalar(length)));
      mesh.scale.set(radius / 2.5, length, radius / 2.5);
    },
  };
}

/** Returns a scene of the robot; view.js says what a scene is. */
export function make_robot_scene(box, report, {store, dark, on_change}) {
  const {robot} = report;
  const renderer = new WebGLRenderer({antialias: true});
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  box.append(renderer.domElement);
  const scene = new Scene();
  scene.add(new AmbientLight(0xffffff, 1.5));
  const camera = new PerspectiveCamera(35, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const lamp = new DirectionalLight(0xffffff, 2.4);
  lamp.position.set(0.4, 0.7, 1);
  camera.add(lamp);  // the lamp follows the camera, so that no side is dark
  scene.add(camera);
  const parts = [...robot.links, ...robot.bodies];
  const meshes = parts.map(mesh_of);
  scene.add(...meshes);

  let placed_frame = -1;
  const place = (frame) => {
    if (frame === placed_frame) return;
    placed_frame = frame;
    meshes.forEach((mesh, k) => {
      mesh.matrix.set(...pose_of(robot, report.frames[frame], k), 0, 0, 0, 1);
      mesh.matrixWorldNeedsUpdate = true;
    });
    scene.updateMatrixWorld();
  };
  const bounds_of = (list) => {
    const bounds = new Box3();
    for (const mesh of list)
      if (mesh.geometry.attributes.position.count > 0)
        bounds.union(mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrixWorld));
    return bounds;
  };
  place(store.state.frame);
  const robot_bounds = bounds_of(meshes.slice(0, robot.links.length));
  const first_view = new Vector3(0.78, -0.52, 0.36).normalize();
  const bounds = robot_bounds.isEmpty() ? bounds_of(meshes) : robot_bounds.clone();
  for (const mesh of meshes.slice(robot.links.length)) {  // a large floor does not push the camera away
    const near = bounds_of([mesh]).intersect(robot_bounds.clone().expandByScalar(robot_bounds.getSize(new Vector3()).length()));
    if (!near.isEmpty()) bounds.union(near);
  }
  const aside = robot_bounds.getCenter(new Vector3()).sub(bounds.getCenter(new Vector3())).setZ(0);
  if (aside.length() > 1e-3 * bounds.getSize(new Vector3()).length())  // the robot stands in front of the bodies
    first_view.copy(aside.normalize().applyAxisAngle(new Vector3(0, 0, 1), 0.9).multiplyScalar(0.93)).setZ(0.36);
  const size = Math.max(1e-6, bounds.getSize(new Vector3()).length());
  const center = bounds.getCenter(new Vector3());
  camera.near = size / 200;
  camera.far = size * 50;
  const step = 10 ** Math.floor(Math.log10(size));
  const half = Math.ceil(size / step) * step;
  const floor = new GridHelper(2 * half, Math.min(40, Math.round(2 * half / step * 2)));
  floor.rotation.x = Math.PI / 2;
  floor.position.set(Math.round(center.x / step) * step, Math.round(center.y / step) * step,
                     bounds.isEmpty() ? 0 : bounds.min.z - size * 1e-3);
  floor.material.transparent = true;
  floor.material.opacity = 0.35;
  floor.material.depthWrite = false;
  scene.add(floor);
  const contacts = make_contacts(scene);

  const orbit = new OrbitControls(camera, renderer.domElement);
  orbit.minDistance = size / 50;
  orbit.maxDistance = size * 10;
  let waits = false;
  const render = () => {
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      renderer.render(scene, camera);
      on_change();
    });
  };
  orbit.addEventListener('change', render);
  renderer.domElement.setAttribute('aria-hidden', 'true');

  const see_through = {on: false};
  const paint = ({frame, selected}) => {
    const colliding = new Set();
    for (const pair of report.frames[frame].pairs) if (pair.collides) colliding.add(pair.a).add(pair.b);
    meshes.forEach((mesh, k) => {
      const {material} = mesh;
      const is_body = k >= robot.links.length;
      const chosen = selected && (selected.a === k || selected.b === k);
      const usual = is_body ? colors.body : robot.links[k].moves ? colors.link : colors.fixed;
      const color = !selected ? (colliding.has(k) ? colors.colliding : usual)
                  : selected.a === k ? colors.first : selected.b === k ? colors.second : usual;
      material.color.set(color);
      const thin = selected ? !chosen : see_through.on;
      material.transparent = thin || Boolean(chosen);
      const hides = chosen && is_body;  // a shelf around a hand, for example
      material.opacity = thin ? (selected ? 0.12 : 0.35) : hides ? 0.3 : chosen ? 0.82 : 1;
      material.depthWrite = !thin && !hides;
      mesh.renderOrder = thin ? 1 : hides ? 2 : chosen ? 3 : 0;  // the chosen link is seen through everything
      material.needsUpdate = true;
    });
  };

  const smaller_part = (pair) =>
    Math.min(...[pair.a, pair.b].map((k) => bounds_of([meshes[k]]).getSize(new Vector3()).length()));
  const vector = (p) => new Vector3(...p);
  const anchors = (pair) => {
    if (pair.points) return pair.points.map(vector);
    return [pair.a, pair.b].map((k) => bounds_of([meshes[k]]).getCenter(new Vector3()));
  };
  const project = (p) => {
    const at = p.clone().project(camera);
    return at.z > 1 ? [-1, -1] : [(at.x + 1) / 2 * box.clientWidth, (1 - at.y) / 2 * box.clientHeight];
  };
  const middle = (pair) => {
    const [p, q] = anchors(pair);
    return p.add(q).multiplyScalar(0.5);
  };

  let moving = 0;
  /** Moves the camera so that a ball around a point fills the picture. */
  const look_at = (target, radius, direction, duration) => {
    const narrow = Math.min(1, camera.aspect);
    const away = radius / Math.sin(Math.PI / 360 * camera.fov) / narrow;
    const from = {target: orbit.target.clone(), position: camera.position.clone()};
    const to = target.clone().addScaledVector(direction, Math.max(away, orbit.minDistance));
    const start = performance.now();
    const turn = ++moving;
    const advance = (now) => {
      if (turn !== moving) return;
      const t = duration > 0 ? Math.min(1, Math.max(0, (now - start) / duration)) : 1;
      const s = t * t * (3 - 2 * t);
      orbit.target.lerpVectors(from.target, target, s);
      camera.position.lerpVectors(from.position, to, s);
      orbit.update();
      render();
      if (t < 1) requestAnimationFrame(advance);
    };
    advance(start + (duration > 0 ? 0 : 1));
  };
  const whole_view = () => look_at(center, size * 0.52, first_view, 0);

  const resize = () => {
    const [width, height] = [box.clientWidth, box.clientHeight];
    if (width === 0 || height === 0) return;
    renderer.setSize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    render();
  };
  const set_dark = (now) => {
    renderer.setClearColor(now ? background.dark : background.light);
    floor.material.color.set(now ? 0x7f8b99 : 0x9aa4af);
    render();
  };
  const show = (state) => {
    place(state.frame);
    paint(state);
    contacts.clear();
    const {pairs} = report.frames[state.frame];
    if (state.selected) contacts.add(anchors(state.selected), Math.min(size * 0.009, 0.06 * smaller_part(state.selected)));
    else
      for (const pair of pairs.slice(0, most_contacts))
        if (pair.collides && pair.points) contacts.add(anchors(pair), size * 0.006);
    render();
  };
  new ResizeObserver(resize).observe(box);
  resize();
  set_dark(dark);
  whole_view();

  const ray = new Raycaster();
  const part_at = (x, y) => {
    ray.setFromCamera(new Vector2(2 * x / box.clientWidth - 1, 1 - 2 * y / box.clientHeight), camera);
    const [hit] = ray.intersectObjects(meshes, false);
    return hit ? meshes.indexOf(hit.object) : -1;
  };
  return {
    show,
    focus(pair, animated) {
      const radius = Math.max(size * 0.05, Math.min(size * 0.4, 0.5 * smaller_part(pair)));
      const direction = camera.position.clone().sub(orbit.target).normalize();
      look_at(middle(pair), radius, direction, animated && !wants_stillness() ? 400 : 0);
    },
    reset: whole_view,
    set_dark,
    anchors,
    project,
    pick(px, py, within) {
      const {pairs} = report.frames[store.state.frame];
      const best = nearest_pair(pairs.filter((pair) => pair.points), (pair) => project(middle(pair)), px, py, within);
      if (best) return best;
      const part = part_at(px, py);
      return pairs.find((pair) => pair.a === part || pair.b === part) ?? null;
    },
    hover(px, py) {
      const part = part_at(px, py);
      return part < 0 ? null : report.labels[part];
    },
    camera: () => [...camera.position.toArray(), ...orbit.target.toArray()],
    controls: [toggle('See through', false, (on) => {
      see_through.on = on;
      show(store.state);
    })],
    legend: [swatch('swatch-link', 'links'), ...(robot.bodies.length > 0 ? [swatch('swatch-body', 'bodies')] : []),
             swatch('swatch-collides', 'in a colliding pair'), swatch('swatch-contact', 'closest points')],
  };
}
