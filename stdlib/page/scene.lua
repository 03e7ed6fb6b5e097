--- The script of a page that draws meshes in 3-D, with three.js (written for its version 111): the data of the page, materials, lights, and a camera that the
--- mouse moves. The script of the page's content follows it.
return [==[
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const view = document.getElementById("view");

const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;

// triangles with separate normals: smooth between neighbors that differ by less than 35 degrees, sharp at edges
function geometryOf(mesh) {
  const p = new Float32Array(bytes(mesh.positions));
  const index = mesh.wide ? new Uint32Array(bytes(mesh.indices)) : new Uint16Array(bytes(mesh.indices));
  const count = index.length / 3, area = new Float32Array(3 * count), unit = new Float32Array(3 * count);
  const first = new Uint32Array(p.length / 3 + 1), around = new Uint32Array(index.length);
  for (let t = 0; t < count; ++t) {
    const [a, b, c] = [3 * index[3 * t], 3 * index[3 * t + 1], 3 * index[3 * t + 2]];
    const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]], v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    for (let k = 0; k < 3; ++k) { area[3 * t + k] = n[k]; unit[3 * t + k] = n[k] / length; }
  }
  for (const v of index) ++first[v + 1];
  for (let v = 1; v < first.length; ++v) first[v] += first[v - 1];
  const next = first.slice();
  for (let i = 0; i < index.length; ++i) around[next[index[i]]++] = (i / 3) | 0;
  const points = new Float32Array(3 * index.length), normals = new Float32Array(3 * index.length);
  const least = Math.cos(35 * Math.PI / 180);
  for (let i = 0; i < index.length; ++i) {
    const t = 3 * ((i / 3) | 0), v = index[i];
    let x = 0, y = 0, z = 0;
    for (let k = first[v]; k < first[v + 1]; ++k) {
      const o = 3 * around[k];
      if (unit[t] * unit[o] + unit[t + 1] * unit[o + 1] + unit[t + 2] * unit[o + 2] < least) continue;
      x += area[o]; y += area[o + 1]; z += area[o + 2];
    }
    const length = Math.hypot(x, y, z) || 1;
    points.set(p.subarray(3 * v, 3 * v + 3), 3 * i);
    normals.set([x / length, y / length, z / length], 3 * i);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  if (mesh.colors) {
    const own = new Uint8Array(bytes(mesh.colors)), shown = new Float32Array(3 * index.length), linear = new THREE.Color();
    for (let t = 0; t < count; ++t) {
      linear.setRGB(own[3 * t] / 255, own[3 * t + 1] / 255, own[3 * t + 2] / 255).convertSRGBToLinear();
      for (let k = 0; k < 3; ++k) shown.set([linear.r, linear.g, linear.b], 9 * t + 3 * k);
    }
    geometry.setAttribute("color", new THREE.BufferAttribute(shown, 3));
  }
  if (mesh.textures) placeImages(geometry, mesh.textures, count);
  geometry.computeBoundingSphere();
  return geometry;
}

// orders the triangles by image, those without an image first, with one group per image
function placeImages(geometry, textures, count) {
  const numbers = new Uint16Array(bytes(textures.numbers)), places = new Float32Array(bytes(textures.places));
  const order = Array.from(numbers.keys()).sort((a, b) => numbers[a] - numbers[b] || a - b);
  for (const name of ["position", "normal", "color"]) {
    const attribute = geometry.getAttribute(name);
    if (!attribute) continue;
    const from = attribute.array, to = new Float32Array(from.length);
    order.forEach((t, i) => to.set(from.subarray(9 * t, 9 * t + 9), 9 * i));
    geometry.setAttribute(name, new THREE.BufferAttribute(to, 3));
  }
  const uv = new Float32Array(6 * count);
  order.forEach((t, i) => uv.set(places.subarray(6 * t, 6 * t + 6), 6 * i));
  geometry.setAttribute("uv", new THREE.BufferAttribute(uv, 2));
  for (let first = 0; first < count;) {
    const number = numbers[order[first]];
    let end = first;
    while (end < count && numbers[order[end]] === number) ++end;
    geometry.addGroup(3 * first, 3 * (end - first), number);
    first = end;
  }
}

const paint = (color, more) => {
  const material = new THREE.MeshStandardMaterial(Object.assign({color, roughness: 0.55, metalness: 0.05}, more));
  material.color.convertSRGBToLinear();
  return material;
};

function place(mesh, n) {
  mesh.position.set(n[0], n[1], n[2]);
  mesh.quaternion.set(n[4], n[5], n[6], n[3]);
}

let renderer = null;
try {
  renderer = new THREE.WebGLRenderer({antialias: true, alpha: true});
  renderer.gammaOutput = true;
  renderer.gammaFactor = 2.2;
} catch (_) {
  view.querySelector(".note").textContent = "This browser does not support WebGL: there is no 3-D view.";
}
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(32, 1, 0.001, 100);
camera.up.set(0, 0, 1);
scene.add(camera);
scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f98, 0.6));
const lamp = new THREE.DirectionalLight(0xfff8f0, 0.7), fill = new THREE.DirectionalLight(0xe6eeff, 0.2);
lamp.position.set(-0.6, 0.9, 0.6);
fill.position.set(0.9, -0.1, 0.5);
camera.add(lamp, lamp.target, fill, fill.target);

const looks = {
  link: paint(0xa9b4c2), base: paint(0x59626e), obstacle: paint(0xcfc8b8),
  object: paint(0x4fa3b8, {transparent: true, opacity: 0.34, depthWrite: false}),
  cone: paint(0xf4511e, {side: THREE.DoubleSide}), point: paint(0x8e1b0a),
};
const geometries = data.meshes.map(geometryOf);
// the material of a kind for meshes with colors per triangle
const colored = {};
function plainLookOf(part) {
  if (!geometries[part.mesh].getAttribute("color")) return looks[part.kind];
  if (!colored[part.kind]) {
    colored[part.kind] = looks[part.kind].clone();
    colored[part.kind].color.setRGB(1, 1, 1);
    colored[part.kind].vertexColors = THREE.VertexColors;
  }
  return colored[part.kind];
}
// the materials of a mesh: that of triangles without an image, then one per image
const images = (data.images || []).map(uri => {
  const image = new Image();
  image.src = uri;
  return image;
});
const wraps = {repeat: THREE.RepeatWrapping, mirror: THREE.MirroredRepeatWrapping, clamp: THREE.ClampToEdgeWrapping};
const pictured = {};  // by kind and mesh
function textured(part, texture) {
  const map = new THREE.Texture(images[texture.image]), look = looks[part.kind].clone();
  map.flipY = false;
  map.encoding = THREE.sRGBEncoding;
  map.wrapS = wraps[texture.wrap[0]];
  map.wrapT = wraps[texture.wrap[1]];
  map.anisotropy = 4;
  images[texture.image].decode().then(() => { map.needsUpdate = true; redraw(); });
  look.map = map;
  look.color.setRGB(...texture.tint).convertSRGBToLinear();
  return look;
}
function lookOf(part) {
  const textures = data.meshes[part.mesh].textures;
  if (!textures) return plainLookOf(part);
  const key = part.kind + " " + part.mesh;
  if (!pictured[key]) pictured[key] = textures.list.map(texture => textured(part, texture));
  return [plainLookOf(part), ...pictured[key]];
}
function setObjectOpacity(seenThrough, otherwise) {
  const images = Object.keys(pictured).filter(key => key.startsWith("object ")).flatMap(key => pictured[key]);
  for (const look of [looks.object, colored.object, ...images]) if (look) {
    look.opacity = seenThrough ? 0.34 : otherwise;
    look.depthWrite = !seenThrough;
  }
}
const solid = part => {
  const mesh = new THREE.Mesh(geometries[part.mesh], lookOf(part));
  if (part.kind === "object") mesh.renderOrder = 2;
  scene.add(mesh);
  return mesh;
};
// --- the camera: azimuth and elevation about a target ---
const orbit = {target: new THREE.Vector3(), distance: 1, azimuth: 0, elevation: 0.4, turned: false};

function draw() {
  if (!renderer) return;
  const {azimuth, elevation, distance, target} = orbit;
  camera.position.set(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation));
  camera.position.multiplyScalar(distance).add(target);
  camera.near = distance / 100;
  camera.far = distance * 20;
  camera.updateProjectionMatrix();
  camera.lookAt(target);
  renderer.render(scene, camera);
}
let waiting = false;
const redraw = () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
};

function resize() {
  if (!renderer) return;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setSize(view.clientWidth, view.clientHeight);
  camera.aspect = view.clientWidth / view.clientHeight;
  draw();
}

// --- mouse input ---
let held = null;
view.addEventListener("pointerdown", e => { held = {x: e.clientX, y: e.clientY, pan: e.button === 2 || e.shiftKey}; view.setPointerCapture(e.pointerId); });
view.addEventListener("pointerup", () => { held = null; });
view.addEventListener("pointercancel", () => { held = null; });
view.addEventListener("contextmenu", e => e.preventDefault());
view.addEventListener("pointermove", e => {
  if (!held) return;
  const dx = e.clientX - held.x, dy = e.clientY - held.y;
  held.x = e.clientX;
  held.y = e.clientY;
  if (held.pan) {
    const scale = 2 * orbit.distance * Math.tan(camera.fov * Math.PI / 360) / view.clientHeight;
    orbit.target.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 0), -dx * scale);
    orbit.target.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrix, 1), dy * scale);
  } else {
    orbit.azimuth -= 0.008 * dx;
    orbit.elevation = Math.max(-1.55, Math.min(1.55, orbit.elevation + 0.008 * dy));
    orbit.turned = true;
  }
  redraw();
});
view.addEventListener("wheel", e => { e.preventDefault(); orbit.distance *= Math.exp(0.001 * e.deltaY); redraw(); }, {passive: false});
]==]
