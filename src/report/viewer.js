// The 3D view of a page: draws the scenes of the section's data with WebGL 2, without a library and without a request.
// Where that is not to be had, the section stays hidden and the page has its pictures. src/report/viewer_data.cpp packs
// what unpacked() reads.
(() => {
  "use strict";
  const section = document.querySelector("section.viewer");
  const canvas = document.createElement("canvas");
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl || !window.DecompressionStream) return;
  const data = JSON.parse(section.querySelector("script").textContent);
  const scenes = data.scenes;

  // --- the controls

  const style = document.createElement("style");
  style.textContent = `
.viewer canvas { display: block; width: 100%; aspect-ratio: 16 / 10; max-height: 80vh; background: var(--soft);
  border-radius: .4rem; touch-action: pan-y; cursor: grab; }
@media (max-width: 40rem) { .viewer canvas { aspect-ratio: 1; } }
.viewer canvas:active { cursor: grabbing; }
.viewer canvas:focus-visible, .viewer button:focus-visible, .viewer input:focus-visible, .viewer select:focus-visible {
  outline: 3px solid #2f7de1; outline-offset: 2px; }
.viewer .bar { display: flex; flex-wrap: wrap; gap: .4rem 1.2rem; align-items: center; margin: .5rem 0; }
.viewer fieldset { border: 0; margin: 0; padding: 0; display: flex; flex-wrap: wrap; gap: .2rem 1rem; min-width: 0; }
.viewer legend { float: left; padding: 0; margin-right: .2rem; }
.viewer label { overflow-wrap: anywhere; } .viewer button { font: inherit; min-width: 2.2rem; min-height: 2.2rem; }
.viewer select { font: inherit; } .viewer p { margin: .3rem 0; }
.viewer .scale { display: flex; gap: .6rem; align-items: center; font-variant-numeric: tabular-nums; flex-wrap: wrap; }
.viewer .scale i { flex: 1 1 8rem; max-width: 20rem; height: 1rem; border: 1px solid var(--line); }`;
  document.head.append(style);

  section.insertAdjacentHTML("beforeend", `
<div class="bar"><fieldset><legend>Show</legend></fieldset></div>
<div class="bar">
  <label>Colours <select name="colours"></select></label>
  <label>Shading <select name="shading"><option value="smooth">smooth</option><option value="flat">flat</option></select></label>
  <label><input type="checkbox" name="wireframe"> wireframe</label>
  <span><button type="button" name="in" aria-label="Zoom in">+</button>
  <button type="button" name="out" aria-label="Zoom out">&minus;</button>
  <button type="button" name="reset">Reset view</button></span>
</div>
<div class="scale" hidden><span></span><i></i><span></span></div>
<p class="caption" aria-live="polite"></p>
<p class="soft" id="viewer-keys">Drag to orbit; Shift and drag, or two fingers, to pan; pinch, or the wheel after a click, to
zoom. With the keyboard: arrows orbit, Shift and arrows pan, + and &minus; zoom, 0 resets.</p>`);
  section.querySelector(".bar").after(canvas);
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-describedby", "viewer-keys");
  const control = (name) => section.querySelector(`[name=${name}]`);
  const fieldset = section.querySelector("fieldset");
  // Without its folder, where that tells it from the others.
  const short_name = (scene) => {
    const last = (name) => name.replace(/^.*\//, "");
    return scenes.some((other) => other !== scene && last(other.name) === last(scene.name)) ? scene.name : last(scene.name);
  };
  scenes.forEach((scene, number) => {
    const label = document.createElement("label"), radio = document.createElement("input");
    radio.type = "radio";
    radio.name = "viewer-scene";
    radio.addEventListener("change", () => show(number));
    label.append(radio, ` ${scene.before ? "before: " : ""}${short_name(scene)}`);
    fieldset.append(label);
    scene.radio = radio;
  });
  fieldset.hidden = scenes.length === 1;
  for (const name of ["colours", "shading", "wireframe"]) control(name).addEventListener("change", () => told());

  // --- scenes

  // Planes of bytes: the n-th bytes of all numbers follow each other.
  function reader(bytes) {
    let at = 0;
    return (count, width) => {
      const out = new Uint32Array(count);
      for (let w = 0; w < width; ++w, at += count)
        for (let i = 0; i < count; ++i) out[i] |= bytes[at + i] << (8 * w);
      return out;
    };
  }

  // Each number less the one before, the sign in the last bit, of so many bytes.
  function summed(codes, width) {
    const mask = width === 2 ? 0xffff : 0xff;
    let sum = 0;
    for (let i = 0; i < codes.length; ++i)
      codes[i] = sum = (sum + (codes[i] & 1 ? -(codes[i] + 1 >> 1) : codes[i] >> 1)) & mask;
    return codes;
  }

  async function unpacked(scene) {
    const packed = Uint8Array.from(atob(scene.data), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const read = reader(new Uint8Array(await new Response(stream).arrayBuffer())), n = scene.vertices;
    const column = (width) => summed(read(n, width), width);
    const out = { position: new Float32Array(3 * n) }, places = new Float64Array(n);
    for (let c = 0; c < 3; ++c) {
      const offset = scene.origin[c] - scenes[0].origin[c]; // so that floats are exact enough far from zero
      column(2).forEach((q, i) => {
        out.position[3 * i + c] = offset + q / 65535 * scene.size[c];
        places[i] = places[i] * 65536 + q;
      });
    }
    if (scene.normals) {
      const x = column(1), y = column(1);
      out.normal = new Float32Array(3 * n);
      for (let i = 0; i < n; ++i) out.normal.set(unfolded(x[i] / 127.5 - 1, y[i] / 127.5 - 1), 3 * i);
    }
    if (scene.coloured) {
      out.colour = new Uint8Array(4 * n);
      for (let c = 0; c < 4; ++c) column(1).forEach((q, i) => { out.colour[4 * i + c] = q; });
    }
    if (scene.uv) {
      out.uv = new Float32Array(2 * n);
      for (let c = 0; c < 2; ++c)
        column(2).forEach((q, i) => { out.uv[2 * i + c] = scene.uv[c] + q / 65535 * scene.uv[2 + c]; });
    }
    if (scene.deviation) {
      out.distance = new Float32Array(n);
      column(2).forEach((q, i) => { out.distance[i] = q / 32767 - 1; });
    }
    out.index = read(3 * scene.triangles, 3);
    let next = 0;
    for (let i = 0; i < out.index.length; ++i) {
      const code = out.index[i];
      out.index[i] = next - code;
      if (code === 0) ++next;
    }
    delete scene.data;
    // Lines and single points come after the vertices of triangles.
    const mesh = scene.triangles ? by_corners(out, places) : {};
    mesh.loose = { position: out.position.subarray(3 * scene.loose), colour: out.colour?.subarray(4 * scene.loose) };
    return mesh;
  }

  // Every corner by itself, with a normal: its own, or of the faces at its place that are within 40 degrees of its face.
  function by_corners(mesh, places) {
    const index = mesh.index, out = { edges: edges_of(index) };
    const widths = { position: 3, normal: 3, colour: 4, uv: 2, distance: 1 };
    for (const [name, width] of Object.entries(widths)) {
      if (!mesh[name]) continue;
      out[name] = new mesh[name].constructor(width * index.length);
      index.forEach((vertex, corner) => {
        for (let c = 0; c < width; ++c) out[name][width * corner + c] = mesh[name][width * vertex + c];
      });
    }
    out.normal ??= normals_of(out.position, index, places);
    return out;
  }

  function normals_of(position, index, places) {
    const faces = index.length / 3, units = new Float32Array(3 * faces), areas = new Float32Array(faces);
    const at_place = new Map();
    for (let f = 0; f < faces; ++f) {
      const [a, b, c] = [0, 3, 6].map((k) => position.subarray(9 * f + k, 9 * f + k + 3));
      const n = cross([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
      areas[f] = Math.hypot(...n);
      if (areas[f] > 0) units.set(times(n, 1 / areas[f]), 3 * f);
      for (let k = 0; k < 3; ++k) {
        const place = places[index[3 * f + k]], there = at_place.get(place);
        if (there) there.push(f);
        else at_place.set(place, [f]);
      }
    }
    const normals = new Float32Array(9 * faces), least = Math.cos(40 * Math.PI / 180);
    for (let corner = 0; corner < index.length; ++corner) {
      const f = 3 * Math.floor(corner / 3);
      let x = 0, y = 0, z = 0;
      for (const g of at_place.get(places[index[corner]])) {
        const u = units[3 * g], v = units[3 * g + 1], w = units[3 * g + 2];
        if (units[f] * u + units[f + 1] * v + units[f + 2] * w < least) continue;
        x += areas[g] * u;
        y += areas[g] * v;
        z += areas[g] * w;
      }
      normals.set(normalised([x, y, z]), 3 * corner);
    }
    return normals;
  }

  // Each edge once, as pairs of corners.
  function edges_of(index) {
    const known = new Set(), pairs = [];
    for (let i = 0; i < index.length; ++i) {
      const j = i % 3 === 2 ? i - 2 : i + 1, a = index[i], b = index[j];
      const key = Math.min(a, b) * 16777216 + Math.max(a, b);
      if (known.has(key)) continue;
      known.add(key);
      pairs.push(i, j);
    }
    return new Uint32Array(pairs);
  }

  // A direction of the octahedron's net (Q. Meyer et al., "On Floating-Point Normal Vectors", 2010).
  function unfolded(x, y) {
    const z = 1 - Math.abs(x) - Math.abs(y), t = Math.max(-z, 0);
    return normalised([x + (x >= 0 ? -t : t), y + (y >= 0 ? -t : t), z]);
  }

  // --- vectors

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const times = (a, s) => a.map((x) => x * s);
  const plus = (...all) => all.reduce((a, b) => a.map((x, i) => x + b[i]));
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const normalised = (a) => times(a, 1 / (Math.hypot(...a) || 1));

  // --- drawing

  const vertex_shader = `#version 300 es
in vec3 position; in vec3 normal; in vec4 colour; in vec2 uv; in float deviation;
uniform mat4 view, projection;
out vec3 eye, side; out vec4 tint; out vec2 place; out float away;
void main() {
  vec4 p = view * vec4(position, 1.0);
  eye = p.xyz; side = mat3(view) * normal; tint = colour; place = uv; away = deviation;
  gl_Position = projection * p;
  gl_PointSize = 3.0;
}`;
  // Lit as the pictures are: from the upper left of the viewer; the inner side is orange.
  const fragment_shader = `#version 300 es
precision highp float;
in vec3 eye, side; in vec4 tint; in vec2 place; in float away;
uniform vec4 base; uniform bool textured, coloured, unlit, both_sides, blends, flat_faces, loose; uniform int mode; uniform float cutoff;
uniform sampler2D image, scale;
out vec4 result;
vec3 encoded(vec3 c) { return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)); }
void main() {
  vec4 c = base;
  if (coloured) c *= tint * tint;
  if (textured) c *= texture(image, place);
  if (mode == 1) c = vec4(0.72, 0.74, 0.78, 1.0);
  if (mode == 2) c = vec4(texture(scale, vec2((away * 0.5 + 0.5) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb, 1.0);
  if (mode == 3) { result = base; return; }
  if (mode == 0 && c.a < cutoff) discard;
  bool inside = !loose && !gl_FrontFacing && !both_sides;
  if (inside) c.rgb = vec3(0.75, 0.3, 0.12);
  if (!loose && !(unlit && mode == 0 && !inside)) {
    vec3 face = normalize(cross(dFdx(eye), dFdy(eye)));
    vec3 n = flat_faces || dot(side, side) < 0.01 ? face : normalize(side) * (gl_FrontFacing ? 1.0 : -1.0);
    c.rgb *= 0.16 + 0.84 * max(0.0, dot(n, normalize(vec3(-0.35, 0.55, 0.75))));
  }
  float alpha = blends ? c.a : 1.0;
  result = vec4(encoded(clamp(c.rgb, 0.0, 1.0)) * alpha, alpha);
}`;

  let program, uniforms, scale_texture, images;
  const attributes = ["position", "normal", "colour", "uv", "deviation"];

  function compiled(kind, source) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }

  // Everything on the graphics processor, which may lose it.
  function set_up() {
    program = gl.createProgram();
    compiled(gl.VERTEX_SHADER, vertex_shader);
    compiled(gl.FRAGMENT_SHADER, fragment_shader);
    attributes.forEach((name, i) => gl.bindAttribLocation(program, i, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return false;
    uniforms = new Proxy({}, { get: (all, name) => all[name] ??= gl.getUniformLocation(program, name) });
    scale_texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, scale_texture);
    const colours = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) colours.set([...on_scale(i / 255), 255], 4 * i);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colours);
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.LINEAR);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    images = data.textures.map(() => null);
    for (const scene of scenes) delete scene.buffers;
    return true;
  }

  // Blue inside, red outside, as in the pictures: K. Moreland, "Diverging color maps for scientific visualization" (2009).
  function on_scale(t) {
    const stops = [[59, 76, 192], [141, 176, 254], [221, 221, 221], [244, 152, 122], [180, 4, 38]];
    const at = Math.min(t * 4, 3.999), i = Math.floor(at);
    return stops[i].map((c, k) => Math.round(c + (stops[i + 1][k] - c) * (at - i)));
  }

  function buffer_of(target, content) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, content, gl.STATIC_DRAW);
    return buffer;
  }

  function buffers_of(scene) {
    if (scene.buffers) return scene.buffers;
    const mesh = scene.mesh, faces = gl.createVertexArray(), loose = gl.createVertexArray();
    gl.bindVertexArray(faces);
    const put = (place, content, size, type, normalised) => {
      if (!content) return;
      buffer_of(gl.ARRAY_BUFFER, content);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, type, normalised, 0, 0);
    };
    put(0, mesh.position, 3, gl.FLOAT, false);
    put(1, mesh.normal, 3, gl.FLOAT, false);
    put(2, mesh.colour, 4, gl.UNSIGNED_BYTE, true);
    put(3, mesh.uv, 2, gl.FLOAT, false);
    put(4, mesh.distance, 1, gl.FLOAT, false);
    if (mesh.edges) buffer_of(gl.ELEMENT_ARRAY_BUFFER, mesh.edges);
    gl.bindVertexArray(loose);
    put(0, mesh.loose.position, 3, gl.FLOAT, false);
    put(2, mesh.loose.colour, 4, gl.UNSIGNED_BYTE, true);
    return scene.buffers = { faces, loose };
  }

  function image_of(number) {
    if (number == null || images[number]) return number == null ? null : images[number].ready && images[number].texture;
    const { src, wrap, nearest } = data.textures[number], entry = images[number] = {}, all = images;
    const image = new Image();
    image.onload = () => {
      if (all !== images) return; // of a context that was lost meanwhile
      entry.texture = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, entry.texture);
      gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
      gl.generateMipmap(gl.TEXTURE_2D);
      const kinds = { repeat: gl.REPEAT, clamp: gl.CLAMP_TO_EDGE, mirror: gl.MIRRORED_REPEAT };
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, kinds[wrap[0]]);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, kinds[wrap[1]]);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
      if (nearest) gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
      entry.ready = true;
      draw();
    };
    image.src = src;
    return null;
  }

  let current = 0, home = 0, waiting = false, yaw, pitch, distance, target;
  const centre_of = (scene) => scene.size.map((s, c) => scene.origin[c] - scenes[0].origin[c] + s / 2);
  const radius_of = (scene) => Math.hypot(...scene.size) / 2 || 1;
  const half_angle = Math.PI / 12;

  function reset() {
    const scene = scenes[home];
    yaw = Math.atan(0.55);
    pitch = Math.atan(0.45 / Math.hypot(1, 0.55));
    target = centre_of(scene);
    const { x, y, z } = axes(), height = Math.tan(half_angle) * 0.92, width = height * (canvas.clientWidth / canvas.clientHeight || 1);
    distance = radius_of(scene) * 0.1;
    for (let corner = 0; corner < 8; ++corner) { // until all of the box is in the picture
      const p = scene.size.map((s, c) => (corner >> c & 1 ? s : -s) / 2);
      distance = Math.max(distance, dot(p, z) + Math.max(Math.abs(dot(p, x)) / width, Math.abs(dot(p, y)) / height));
    }
  }

  // Whether a scene is seen well by the camera of the other.
  function comparable(a, b) {
    const r = radius_of(a), s = radius_of(b);
    return r < 3 * s && s < 3 * r && Math.hypot(...plus(centre_of(a), times(centre_of(b), -1))) < Math.max(r, s);
  }

  function axes() {
    const { up, front } = scenes[home], right = cross(up, front);
    const towards = plus(times(front, Math.cos(pitch) * Math.cos(yaw)), times(right, Math.cos(pitch) * Math.sin(yaw)),
                         times(up, Math.sin(pitch)));
    const x = normalised(cross(up, towards));
    return { x, y: cross(towards, x), z: towards };
  }

  function draw() {
    if (!waiting) requestAnimationFrame(draw_now);
    waiting = true;
  }

  function draw_now() {
    waiting = false;
    const scene = scenes[current];
    if (!scene.mesh || gl.isContextLost()) return;
    const ratio = Math.min(devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio)), height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(program);
    place_camera(width / height);
    gl.bindVertexArray(buffers_of(scene).faces);
    gl.vertexAttrib4f(2, 1, 1, 1, 1);
    const colours = control("colours").value, wireframe = control("wireframe").checked;
    const mode = { material: 0, plain: 1, deviation: 2 }[colours];
    gl.uniform1i(uniforms.flat_faces, control("shading").value === "flat");
    gl.uniform1i(uniforms.image, 0);
    gl.uniform1i(uniforms.scale, 1);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, scale_texture);
    gl.activeTexture(gl.TEXTURE0);
    if (scene.triangles) draw_faces(scene, mode, wireframe);
    if (wireframe && scene.triangles) draw_edges(scene);
    gl.bindVertexArray(buffers_of(scene).loose);
    draw_loose(scene, mode);
    gl.bindVertexArray(null);
    canvas.dataset.frames = Number(canvas.dataset.frames || 0) + 1;
  }

  function place_camera(aspect) {
    const { x, y, z } = axes(), eye = plus(target, times(z, distance)), radius = radius_of(scenes[home]);
    const off = Math.hypot(...plus(target, times(centre_of(scenes[current]), -1))) + radius_of(scenes[current]);
    const near = Math.max(distance - off, distance * 0.005, radius * 1e-5), far = Math.max(distance + off, near * 2);
    const f = 1 / Math.tan(half_angle);
    gl.uniformMatrix4fv(uniforms.view, false, [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
                                               -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
    gl.uniformMatrix4fv(uniforms.projection, false, [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1,
                                                     0, 0, 2 * far * near / (near - far), 0]);
  }

  // Lines and single points have their colour, or all the same one, and no light and no distance.
  function draw_loose(scene, mode) {
    if (scene.loose === scene.vertices) return;
    gl.uniform1i(uniforms.loose, 1);
    gl.uniform4fv(uniforms.base, mode === 0 ? [1, 1, 1, 1] : [0.16, 0.20, 0.28, 1]);
    for (const name of ["textured", "unlit", "both_sides", "blends"]) gl.uniform1i(uniforms[name], 0);
    gl.uniform1i(uniforms.coloured, mode === 0);
    gl.uniform1f(uniforms.cutoff, -1);
    gl.uniform1i(uniforms.mode, 0);
    gl.drawArrays(gl.LINES, 0, scene.dots - scene.loose);
    gl.drawArrays(gl.POINTS, scene.dots - scene.loose, scene.vertices - scene.dots);
    gl.uniform1i(uniforms.loose, 0);
  }

  // What blends comes last, over all else; grey and deviations are opaque.
  function draw_faces(scene, mode, wireframe) {
    const over = wireframe || scene.loose < scene.dots; // lines on the surface
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const blending of [false, true]) {
      let first = 0;
      for (const group of scene.groups) {
        const blends = group.alpha === "blend" && mode === 0;
        if (blends === blending) {
          const texture = mode === 0 ? image_of(group.texture) : null;
          gl.bindTexture(gl.TEXTURE_2D, texture || scale_texture);
          gl.uniform1i(uniforms.mode, mode === 2 && group.cap ? 1 : mode);
          gl.uniform1i(uniforms.textured, Boolean(texture));
          gl.uniform4fv(uniforms.base, group.base);
          gl.uniform1i(uniforms.blends, blends);
          gl.uniform1i(uniforms.coloured, group.coloured);
          gl.uniform1i(uniforms.unlit, group.unlit);
          gl.uniform1i(uniforms.both_sides, group.double_sided);
          gl.uniform1f(uniforms.cutoff, group.alpha === "mask" ? group.cutoff : -1);
          if (blends) gl.enable(gl.BLEND);
          gl.depthMask(!blends);
          draw_sides(group, first, over);
        }
        first += group.count;
      }
    }
    gl.disable(gl.BLEND);
    gl.depthMask(true);
    gl.disable(gl.POLYGON_OFFSET_FILL);
  }

  // Inner sides lie a little deeper, so that they do not show through at the edges of outer ones.
  function draw_sides(group, first, over) {
    const own = over ? 1 : 0, draw_them = () => gl.drawArrays(gl.TRIANGLES, 3 * first, 3 * group.count);
    gl.polygonOffset(own, own);
    if (group.double_sided) return draw_them();
    gl.enable(gl.CULL_FACE);
    for (const [hidden, deeper] of [[gl.FRONT, 1], [gl.BACK, 0]]) {
      gl.cullFace(hidden);
      gl.polygonOffset(own + deeper, own + 2 * deeper);
      draw_them();
    }
    gl.disable(gl.CULL_FACE);
  }

  function draw_edges(scene) {
    gl.uniform1i(uniforms.mode, 3);
    gl.uniform4fv(uniforms.base, [0.03, 0.04, 0.07, 0.6]);
    gl.enable(gl.BLEND);
    gl.drawElements(gl.LINES, scene.mesh.edges.length, gl.UNSIGNED_INT, 0);
    gl.disable(gl.BLEND);
  }

  // --- what is told

  const grouped = (n) => n.toLocaleString("en");

  function told() {
    const scene = scenes[current], heat = control("colours").value === "deviation";
    const kinds = [[scene.triangles, scene.faces, "triangles"], [(scene.dots - scene.loose) / 2, scene.lines, "lines"],
                   [scene.vertices - scene.dots, scene.points, "points"]];
    const shown = kinds.filter(([, all]) => all > 0).map(([shown, all, what]) =>
      shown < all ? `${grouped(shown)} of ${grouped(all)} ${what}` : `all ${grouped(all)} ${what}`);
    section.querySelector(".caption").textContent =
      `${scene.before ? "Before: " : ""}${scene.name}, shown with ${shown.join(", ")}.` +
      (scene.deviation && heat ? ` Colours: signed distance from ${scene.reference}, blue inside, red outside` +
        `${scene.groups.some((group) => group.cap) ? "; faces that close cuts (caps) are grey" : ""}.` : "") +
      (scene.note && !heat ? ` ${scene.note}` : "") + (data.left_out ? ` ${data.left_out}` : "");
    canvas.setAttribute("aria-label", `3D view of ${scene.name}`);
    const scale = section.querySelector(".scale"), [low, high] = scale.querySelectorAll("span");
    scale.hidden = !(scene.deviation && heat);
    if (!scale.hidden) {
      const unit = scene.unit ? ` ${scene.unit}` : "", most = Number(scene.deviation.toPrecision(3));
      low.textContent = `\u2212${most}${unit}`;
      high.textContent = `+${most}${unit} (largest ${Number(scene.largest.toPrecision(3))}${unit})`;
      const steps = [0, 0.25, 0.5, 0.75, 1].map((t) => `rgb(${on_scale(t)})`);
      scale.querySelector("i").style.background = `linear-gradient(90deg, ${steps})`;
    }
    draw();
  }

  async function show(number) {
    current = number;
    const scene = scenes[number], colours = control("colours");
    scene.mesh ??= await unpacked(scene);
    if (current !== number) return;
    scene.radio.checked = true;
    if (!comparable(scene, scenes[home])) {
      home = number;
      reset();
    }
    const wanted = colours.value;
    const choices = [["material", "materials"], ["plain", "grey"]].concat(scene.deviation ? [["deviation", "deviation"]] : []);
    colours.replaceChildren(...choices.map(([value, text]) => new Option(text, value, false, value === wanted)));
    told();
  }

  // --- the hand

  function orbit(right, up) {
    yaw -= right;
    pitch = Math.max(-1.55, Math.min(1.55, pitch + up));
    draw();
  }
  function pan(right, up) { // in parts of the height of the view
    const { x, y } = axes(), size = 2 * distance * Math.tan(half_angle);
    target = plus(target, times(x, -right * size), times(y, -up * size));
    draw();
  }
  function zoom(factor) {
    const radius = radius_of(scenes[home]);
    distance = Math.max(radius * 0.01, Math.min(radius * 100, distance / factor));
    draw();
  }

  const fingers = new Map();
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    const from = fingers.get(e.pointerId), to = [e.clientX, e.clientY], height = canvas.clientHeight;
    if (!from) return;
    const [dx, dy] = [(to[0] - from[0]) / height, (to[1] - from[1]) / height];
    if (fingers.size === 1) {
      if (e.shiftKey || e.buttons & 6) pan(dx, -dy);
      else orbit(dx * 3, dy * 3);
    } else {
      const other = [...fingers].find(([id]) => id !== e.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      pan(dx / 2, -dy / 2);
      zoom(apart(to) / apart(from));
    }
    fingers.set(e.pointerId, to);
  });
  canvas.addEventListener("wheel", (e) => {
    if (document.activeElement !== canvas && !e.ctrlKey) return; // the page scrolls
    e.preventDefault();
    zoom(Math.exp(-e.deltaY * (e.deltaMode ? 0.05 : 0.0015)));
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    const move = e.shiftKey ? (x, y) => pan(x * 0.05, y * 0.05) : (x, y) => orbit(x * 0.15, -y * 0.15);
    const keys = { ArrowLeft: () => move(-1, 0), ArrowRight: () => move(1, 0), ArrowUp: () => move(0, 1), ArrowDown: () => move(0, -1),
                   "+": () => zoom(1.2), "=": () => zoom(1.2), "-": () => zoom(1 / 1.2), 0: home_view, Home: home_view };
    if (!Object.hasOwn(keys, e.key) || e.altKey || e.ctrlKey || e.metaKey) return;
    e.preventDefault();
    keys[e.key]();
  });
  function home_view() {
    reset();
    draw();
  }
  control("in").addEventListener("click", () => zoom(1.3));
  control("out").addEventListener("click", () => zoom(1 / 1.3));
  control("reset").addEventListener("click", home_view);
  canvas.addEventListener("webglcontextlost", (e) => e.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => { if (set_up()) draw(); });
  new ResizeObserver(draw).observe(canvas);

  if (!set_up()) return;
  const first = Math.max(0, scenes.findIndex((scene) => !scene.before));
  home = first;
  show(first).then(() => {
    section.hidden = false;
    reset();
    draw();
  });
})();
