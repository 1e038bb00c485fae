// In a project with the packed packages and Vite installed, and a model a.glb: node vite.mjs
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import facetmill from 'facetmill/vite';
import { build, createServer } from 'vite';

fs.writeFileSync('mill.yaml', 'facetmill: 1\nparams: {input: {type: path}}\nstages: [{load: "${input}"}, {simplify: 50%}, {write: small.glb}]\n');
fs.writeFileSync('index.html', '<script type="module" src="/main.js"></script>');
fs.writeFileSync('main.js', "import a from './a.glb?mill=web';\nimport b from './a.glb?mill=mill.yaml';\ndocument.title = a + b;\n");
const config = { configFile: false, logLevel: 'error', plugins: [facetmill()], build: { assetsInlineLimit: 0 } };
await build(config);
const written = fs.readdirSync('dist/assets').filter((name) => name.endsWith('.glb')).sort();
assert.equal(written.length, 2);
const script = fs.readFileSync(path.join('dist/assets', fs.readdirSync('dist/assets').find((name) => name.endsWith('.js'))), 'utf8');
for (const name of written) {
  assert(script.includes(name));
  assert.equal(fs.readFileSync(path.join('dist/assets', name)).toString('latin1', 0, 4), 'glTF');
}
const server = await createServer({ ...config, server: { port: 0 } });
await server.listen();
const origin = `http://localhost:${server.httpServer.address().port}`;
const module = await (await fetch(`${origin}/a.glb?import&mill=web`)).text();
const served = await fetch(origin + /"(.*?)"/.exec(module)[1]);
assert.equal(served.headers.get('content-type'), 'model/gltf-binary');
assert.deepEqual(Buffer.from(await served.arrayBuffer()), fs.readFileSync(path.join('dist/assets', written.find((name) => name.startsWith('a-')))));
await server.close();
console.log('vite: all passed');
