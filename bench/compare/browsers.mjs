// node browsers.mjs MODULES OUT FILE.glb...
// Loads each file in three.js and in Babylon.js (headless Chromium, software GL), with animations at half of their
// length, and writes a picture of each, OUT/NAME.three.png and OUT/NAME.babylon.png, both of what three.js finds to be
// the box: Babylon's is that of turned boxes. Prints triangles, draw calls, the box and what the console complained of;
// fails when a file does not load or something is complained of.
//
// npm install three babylonjs babylonjs-loaders puppeteer-core meshoptimizer gives MODULES/node_modules; apt-get install chromium
import { createServer } from 'node:http';
import { existsSync, mkdirSync, readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join, resolve } from 'node:path';

const [modules, out, ...files] = process.argv.slice(2);
const root = resolve(modules, 'node_modules');
const puppeteer = createRequire(join(root, 'x.js'))('puppeteer-core');
const libs = '/m/three/examples/jsm/libs';

const three = `<!doctype html><body style="margin:0"><canvas id=c width=400 height=400></canvas>
<script type=importmap>{"imports":{"three":"/m/three/build/three.module.js","three/addons/":"/m/three/examples/jsm/"}}</script>
<script type=module>
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
const renderer = new THREE.WebGLRenderer({ canvas: document.getElementById('c'), antialias: true, preserveDrawingBuffer: true });
renderer.setClearColor(0x8090a0);
const draco = new DRACOLoader().setDecoderPath('${libs}/draco/gltf/').setWorkerLimit(1);
const loader = new GLTFLoader().setDRACOLoader(draco).setMeshoptDecoder(MeshoptDecoder);
window.draw = async (url) => {
  const asset = await loader.loadAsync(url), scene = new THREE.Scene(), sun = new THREE.DirectionalLight(0xffffff, 2);
  sun.position.set(1, 2, 3);
  scene.add(asset.scene, new THREE.HemisphereLight(0xffffff, 0x444444, 2), sun);
  if (asset.animations.length) {
    const mixer = new THREE.AnimationMixer(asset.scene);
    for (const clip of asset.animations) mixer.clipAction(clip).play();
    mixer.setTime(asset.animations[0].duration / 2);
  }
  asset.scene.updateMatrixWorld(true);
  const box = new THREE.Box3();
  let triangles = 0;
  asset.scene.traverse((o) => {
    if (!o.isMesh) return;
    const g = o.geometry;
    triangles += (g.index ? g.index.count : g.attributes.position.count) / 3 * (o.isInstancedMesh ? o.count : 1);
    if (o.isInstancedMesh) { o.computeBoundingBox(); box.union(o.boundingBox.clone().applyMatrix4(o.matrixWorld)); }
    else box.expandByObject(o, true);
  });
  const size = box.getSize(new THREE.Vector3()).length() || 1, centre = box.getCenter(new THREE.Vector3());
  const camera = new THREE.PerspectiveCamera(35, 1, size / 100, size * 10);
  camera.position.copy(centre).add(new THREE.Vector3(0.5, 0.4, 1).normalize().multiplyScalar(size * 1.5));
  camera.lookAt(centre);
  renderer.render(scene, camera);
  return { triangles, calls: renderer.info.render.calls, box: [...box.min.toArray(), ...box.max.toArray()] };
};
window.ready = true;
</script>`;

const babylon = `<!doctype html><body style="margin:0"><canvas id=c width=400 height=400></canvas>
<script src="/m/babylonjs/babylon.js"></script><script src="/m/babylonjs-loaders/babylonjs.loaders.js"></script><script>
BABYLON.MeshoptCompression.Configuration = { decoder: { url: '/m/meshoptimizer/meshopt_decoder.cjs' } };
BABYLON.DracoDecoder.DefaultConfiguration = { wasmUrl: '${libs}/draco/gltf/draco_wasm_wrapper.js',
  wasmBinaryUrl: '${libs}/draco/gltf/draco_decoder.wasm', fallbackUrl: '${libs}/draco/gltf/draco_decoder.js' };
BABYLON.SceneLoader.ShowLoadingScreen = false;
const engine = new BABYLON.Engine(document.getElementById('c'), true, { preserveDrawingBuffer: true });
window.draw = async (url, box) => {
  const scene = new BABYLON.Scene(engine);
  scene.clearColor = new BABYLON.Color4(0.5, 0.56, 0.63, 1);
  await BABYLON.SceneLoader.AppendAsync('', url, scene, null, '.glb');
  new BABYLON.HemisphericLight('light', new BABYLON.Vector3(1, 2, 3), scene);
  for (const group of scene.animationGroups) group.stop();
  for (const group of scene.animationGroups) {
    group.start(false);
    group.goToFrame((group.from + group.to) / 2);
    group.pause();
  }
  const meshes = scene.meshes.filter((m) => m.getTotalVertices() > 0);
  let triangles = 0, low, high;
  for (const mesh of meshes) {
    mesh.computeWorldMatrix(true);
    triangles += mesh.getTotalIndices() / 3 * (mesh.thinInstanceCount || 1);
    if (!mesh.thinInstanceCount) mesh.refreshBoundingInfo({ applySkeleton: true, applyMorph: true });
    const box = mesh.getBoundingInfo().boundingBox;
    low = low ? BABYLON.Vector3.Minimize(low, box.minimumWorld) : box.minimumWorld.clone();
    high = high ? BABYLON.Vector3.Maximize(high, box.maximumWorld) : box.maximumWorld.clone();
  }
  const found = [...low.asArray(), ...high.asArray()];
  if (box) { // of three.js, whose x points the other way
    low = new BABYLON.Vector3(-box[3], box[1], box[2]);
    high = new BABYLON.Vector3(-box[0], box[4], box[5]);
  }
  const size = high.subtract(low).length() || 1, centre = low.add(high).scale(0.5);
  const from = centre.add(new BABYLON.Vector3(0.5, 0.4, 1).normalize().scale(size * 1.5));
  const camera = new BABYLON.FreeCamera('camera', from, scene);
  Object.assign(camera, { minZ: size / 100, maxZ: size * 10, fov: 0.61 });
  camera.setTarget(centre);
  await scene.whenReadyAsync();
  scene.render();
  return { triangles, calls: meshes.length, box: found };
};
window.ready = true;
</script>`;

const types = { js: 'text/javascript', cjs: 'text/javascript', wasm: 'application/wasm' };
const server = createServer((request, answer) => {
  const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  const page = { '/three': three, '/babylon': babylon }[path];
  const file = path.startsWith('/m/') ? join(root, path.slice(3)) : path.slice(2);
  if (!page && !existsSync(file)) return answer.writeHead(404).end();
  answer.writeHead(200, { 'content-type': page ? 'text/html' : types[file.split('.').pop()] ?? 'application/octet-stream' });
  answer.end(page ?? readFileSync(file));
}).listen(0);
mkdirSync(out, { recursive: true });
const browser = await puppeteer.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'], protocolTimeout: 300000 });
let failed = 0;
const boxes = {}; // by file, of three.js
for (const viewer of ['three', 'babylon']) {
  const page = await browser.newPage(), said = [];
  page.on('pageerror', (error) => said.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && said.push(message.text()));
  await page.setViewport({ width: 400, height: 400 });
  await page.goto(`http://localhost:${server.address().port}/${viewer}`);
  await page.waitForFunction('window.ready', { timeout: 120000 });
  said.length = 0; // of the page itself: it has no icon
  for (const file of files) {
    said.length = 0;
    let drawn;
    try {
      drawn = await page.evaluate((url, box) => window.draw(url, box), `/f${resolve(file)}`, boxes[file] ?? null);
      boxes[file] ??= drawn.box;
      await (await page.$('#c')).screenshot({ path: join(out, `${basename(file, '.glb')}.${viewer}.png`) });
    } catch (error) {
      said.push(String(error));
    }
    failed += said.length > 0;
    console.log(JSON.stringify({ file: basename(file), viewer, ...drawn, said }));
  }
  await page.close();
}
await browser.close();
server.close();
console.log(`${files.length} files, ${failed} complaints`);
process.exit(failed > 0 ? 1 : 0);
