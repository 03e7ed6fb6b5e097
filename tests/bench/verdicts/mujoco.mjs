// The six-direction force test in MuJoCo: node tests/bench/verdicts/mujoco.mjs FOLDER_OF_mujoco-js [option=value...] FILE...
// FILE: as `bench_verdicts --pieces` writes it. Prints how many grasps are held, and how often its verdicts agree with study.shake, and with our engine's on the same pieces.
import fs from 'fs';
import path from 'path';
import {pathToFileURL} from 'url';

// soft 0: contacts as stiff as four steps allow; 1: as MuJoCo has them, which lets fingers sink in by a millimetre
const options = {kp: 5, step: 0.001, condim: 3, impratio: 10, soft: 0};
const files = [];
for (const word of process.argv.slice(3)) {
  const [name, value] = word.split('=');
  if (value === undefined) files.push(word);
  else if (name in options) options[name] = Number(value);
  else throw new Error(`unknown option '${name}'`);
}
const load = (await import(pathToFileURL(path.resolve(process.argv[2], 'dist/mujoco_wasm.js')))).default;
const mujoco = await load();
mujoco.FS.mkdir('/grips');

// poses are [position, quaternion with w first]
const add = (a, b) => a.map((x, i) => x + b[i]), sub = (a, b) => a.map((x, i) => x - b[i]), length = (v) => Math.hypot(...v);
const product = (a, b) => [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                           a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]];
const conjugate = (q) => [q[0], -q[1], -q[2], -q[3]];
const rotate = (q, v) => product(product(q, [0, ...v]), conjugate(q)).slice(1);
const relative = (A, B) => [rotate(conjugate(A[1]), sub(B[0], A[0])), product(conjugate(A[1]), B[1])];

function model_of(scene, grasp) {
  const {links, dofs} = scene.hand;
  let assets = '', count = 0;
  const stiff = options.soft ? '' : `solref="${4 * options.step} 1" solimp="0.95 0.99 0.0001"`;
  const geoms = (pieces, kind) => (pieces || []).map((points) => {
    const name = `piece${count++}`;
    assets += `<mesh name="${name}" vertex="${points.flat().join(' ')}"/>`;
    return `<geom type="mesh" mesh="${name}" ${kind} friction="${scene.mu} 0.005 0.0001" condim="${options.condim}" ${stiff}/>`;
  }).join('');
  const inertial = ({com, mass, inertia: I}) => `<inertial pos="${com.join(' ')}" mass="${Math.max(mass, 1e-4)}" fullinertia="${
    [I[0][0] + 1e-8, I[1][1] + 1e-8, I[2][2] + 1e-8, I[0][1], I[0][2], I[1][2]].join(' ')}"/>`;
  const body = (i) => {
    const link = links[i], X = i === 0 ? grasp.pose : relative(links[link.parent].pose, link.pose);
    let text = `<body name="link${i}" pos="${X[0].join(' ')}" quat="${X[1].join(' ')}">`;
    if (i > 0) text += inertial(link);
    if (link.joint) {
      const dof = dofs[link.joint.dof], range = [dof.min, dof.max].map((x) => (x - dof.value) * link.joint.ratio);
      text += `<joint name="joint${i}" type="${link.joint.kind === 'revolute' ? 'hinge' : 'slide'}" axis="${rotate(conjugate(link.pose[1]), link.joint.axis).join(' ')}"
        pos="${rotate(conjugate(link.pose[1]), sub(link.joint.point, link.pose[0])).join(' ')}"
        damping="${dof.damping}" frictionloss="${dof.friction}" armature="${dof.armature}" ${range.every(Number.isFinite) ? `limited="true" range="${range.join(' ')}"` : ''}/>`;
    }
    text += geoms(link.pieces, 'contype="1" conaffinity="2"');
    links.forEach((other, k) => { if (k > 0 && other.parent === i) text += body(k); });
    return text + '</body>';
  };
  const servos = links.map((link, i) => !link.joint ? '' :
    `<position joint="joint${i}" kp="${options.kp * (link.joint.kind === 'revolute' ? 1 : 100)}" dampratio="1"/>`).join('');
  const hand = body(0), object = geoms(scene.object.pieces, 'contype="2" conaffinity="1"');
  return `<mujoco><compiler angle="radian" balanceinertia="true" boundmass="1e-6" boundinertia="1e-9"/>
    <option timestep="${options.step}" gravity="0 0 0" cone="elliptic" impratio="${options.impratio}" integrator="implicitfast"><flag multiccd="enable"/></option>
    <size memory="64M"/><asset>${assets}</asset>
    <worldbody>${hand}<body name="object"><freejoint/>${inertial(scene.object)}${object}</body></worldbody><actuator>${servos}</actuator></mujoco>`;
}

const max_distance = 0.05, max_angle = 15 * Math.PI / 180;

function shake(scene, grasp) {
  mujoco.FS.writeFile('/grips/grip.xml', model_of(scene, grasp));
  const model = mujoco.MjModel.loadFromXML('/grips/grip.xml'), data = new mujoco.MjData(model);
  const number = (kind, name) => mujoco.mj_name2id(model, kind, name), object = number(1, 'object');
  const joints = [];
  scene.hand.links.forEach(({joint}, i) => {
    if (!joint) return;
    const id = number(3, `joint${i}`);
    joints.push({joint, q: model.jnt_qposadr[id], v: model.jnt_dofadr[id]});
  });
  joints.forEach(({joint, q}, k) => { data.ctrl[k] = data.qpos[q] = (grasp.dofs[joint.dof] - scene.hand.dofs[joint.dof].value) * joint.ratio; });
  const pose = () => [Array.from(data.xpos.slice(3 * object, 3 * object + 3)), Array.from(data.xquat.slice(4 * object, 4 * object + 4))];
  const com = (X) => add(X[0], rotate(X[1], scene.object.com));
  const is_lost = (A, B) => {
    const turn = product(conjugate(A[1]), B[1]), angle = 2 * Math.atan2(length(turn.slice(1)), Math.abs(turn[0]));
    return !(length(sub(com(B), com(A))) <= max_distance && angle <= max_angle);
  };
  const run = (seconds, before) => {
    const steps = Math.round(seconds / options.step);
    for (let k = 1; k <= steps; ++k) {
      if (before && before(k / steps) === false) return;
      mujoco.mj_step(model, data);
    }
  };
  run(0.5, (share) => joints.forEach(({joint, v}) => { data.qfrc_applied[v] = share * (grasp.torques ? grasp.torques[joint.dof] : 0) / joint.ratio; }));
  const pressed = pose();
  run(1);
  const rest = pose();
  let held = 0;
  if (!is_lost(pressed, rest) && data.ncon > 0) {
    const kept = ['qpos', 'qvel', 'qacc_warmstart'].map((name) => [name, Array.from(data[name])]);
    for (let axis = 0; axis < 3; ++axis) {
      for (const sign of [1, -1]) {
        for (const [name, values] of kept) data[name].set(values);
        mujoco.mj_forward(model, data);
        let lost = false;
        run(2, () => {
          lost = lost || is_lost(rest, pose());
          data.xfrc_applied[6 * object + axis] = sign * scene.force;
          return !lost;
        });
        data.xfrc_applied[6 * object + axis] = 0;
        if (!lost && !is_lost(rest, pose())) ++held;
      }
    }
  }
  data.delete(), model.delete();
  return held === 6;
}

const share = (part, t) => `${(100 * part / Math.max(1, t.count)).toFixed(1)} %`;
const print = (name, t) => console.log(name.padEnd(28), [t.count, t.study, t.ours, t.theirs].map((n) => String(n).padStart(9)).join(' '),
  [t.study_agrees, t.ours_agrees].map((n) => share(n, t).padStart(9)).join(' '), [t.verified, t.verified_survived].map((n) => String(n).padStart(9)).join(' '));
const none = () => ({count: 0, study: 0, ours: 0, theirs: 0, study_agrees: 0, ours_agrees: 0, verified: 0, verified_survived: 0});
console.log('held'.padEnd(28), ['of', 'by study', 'pieces', 'in MuJoCo', 'agree', 'agree', 'verified', 'in MuJoCo'].map((word) => word.padStart(9)).join(' '));
const all = none();
for (const file of files) {
  const scene = JSON.parse(fs.readFileSync(file)), tally = none();
  for (const grasp of scene.grasps) {
    const survived = shake(scene, grasp);
    for (const t of [tally, all]) {
      t.count++, t.study += grasp.survived, t.ours += grasp.survived_on_pieces, t.theirs += survived;
      t.study_agrees += grasp.survived === survived, t.ours_agrees += grasp.survived_on_pieces === survived;
      t.verified += grasp.verified, t.verified_survived += grasp.verified && survived;
    }
  }
  print(`${scene.hand_name}, ${scene.object_name}`, tally);
}
print('all', all);
