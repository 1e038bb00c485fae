// import url from './chair.glb?mill=web': runs the ready pipeline `web`, or the pipeline file of that name, on the model.
import { createHash } from 'node:crypto';
import { existsSync } from 'node:fs';
import { mkdtemp, readFile, readdir, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { run } from './index.mjs';

const pattern = /[?&]mill=([^&]+)/;

/**
 * The plugin for Vite. The pipeline must have a param `input` and write one .glb or .gltf; facetmill's own cache makes
 * the next build quick. `params` are given to every pipeline that has them.
 */
export default function facetmill({ params = {} } = {}) {
  let root = process.cwd(), building = true;
  const files = new Map();
  return {
    name: 'facetmill',
    enforce: 'pre',
    configResolved(config) {
      root = config.root;
      building = config.command === 'build';
    },
    async load(id) {
      const match = pattern.exec(id);
      if (!match) return null;
      const model = id.replace(/[?].*$/, '');
      const name = decodeURIComponent(match[1]);
      const file = path.resolve(root, name);
      const pipeline = name.includes('.') && existsSync(file) ? file : name;
      if (pipeline === file) this.addWatchFile(file);
      this.addWatchFile(model);
      const folder = await mkdtemp(path.join(tmpdir(), 'facetmill-vite-'));
      try {
        const report = await run(pipeline, { params: { input: model, ...params }, outputDir: folder, options: ['--cache'] });
        for (const input of report.inputs) this.addWatchFile(path.resolve(input.path));
        const written = (await readdir(folder)).filter((f) => /[.](glb|gltf)$/.test(f));
        if (written.length !== 1) this.error(`${name} writes ${written.length} .glb or .gltf files for ${model}, one is needed`);
        const source = await readFile(path.join(folder, written[0]));
        if (building) {
          const reference = this.emitFile({ type: 'asset', name: written[0], source });
          return `export default import.meta.ROLLUP_FILE_URL_${reference}`;
        }
        const key = createHash('sha256').update(source).digest('hex').slice(0, 16);
        const url = `/@facetmill/${key}/${written[0]}`;
        files.set(url, source);
        return `export default ${JSON.stringify(url)}`;
      } finally {
        await rm(folder, { recursive: true, force: true });
      }
    },
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const source = files.get(request.url.replace(/[?].*$/, ''));
        if (!source) return next();
        response.setHeader('Content-Type', 'model/gltf-binary');
        response.end(source);
      });
    },
  };
}
