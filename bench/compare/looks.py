#!/usr/bin/env python3
"""Pictures of `facetmill render` beside those of the same files by three.js in Chromium: the same camera, the same light.

  looks.py --three node_modules/three [--pairs FOLDER] FILE.glb ...

For each file, and for small ones made here that show a feature of materials each: the structural similarity of both pictures
(Z. Wang et al., 2004; 1: equal) on grey ground, and the part of the pixels that differ by more than 16 of 255. --pairs keeps
both beside each other. Light is diffuse, as facetmill has it, so that metalness and roughness do not count; inner sides are
orange; skinned and morphed parts in the pose of their nodes; no occlusion. A GLB or glTF file with data: URIs.

npm install three;  pip install numpy pillow scikit-image;  apt-get install chromium"""

import argparse
import base64
import functools
import http.server
import io
import json
import pathlib
import struct
import sys
import tempfile
import threading

import numpy
from PIL import Image
from skimage.metrics import structural_similarity

from peers import ROOT, output

sys.path.insert(0, str(ROOT / "tests/golden"))
from browser import Browser  # noqa: E402

WIDTH, HEIGHT, GROUND = 800, 600, 128

PAGE = """<!DOCTYPE html><body style="margin: 0"><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { DRACOLoader } from "three/addons/loaders/DRACOLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
const width = WIDTH, height = HEIGHT;
const renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
renderer.setPixelRatio(1);
renderer.setSize(width, height);
document.body.append(renderer.domElement);

// Diffuse, with the textures that facetmill draws.
function plain(own) {
  const Kind = own.isMeshBasicMaterial ? THREE.MeshBasicMaterial : THREE.MeshLambertMaterial;
  const { color, map, vertexColors, opacity, transparent, alphaTest, side, depthWrite } = own;
  const m = new Kind({ color, map, vertexColors, opacity, transparent, alphaTest, side, depthWrite });
  if (!own.isMeshBasicMaterial) {
    for (const k of ["normalMap", "aoMap", "aoMapIntensity", "emissive", "emissiveMap", "emissiveIntensity", "flatShading"])
      if (own[k] != null) m[k] = own[k];
    if (own.normalScale) m.normalScale = own.normalScale;
  }
  return m;
}

// In the world, as joints and morph weights have it.
function posed(node) {
  const geometry = node.geometry.clone(), place = geometry.attributes.position, normal = geometry.attributes.normal;
  const p = new THREE.Vector3(), n = new THREE.Vector3(), q = new THREE.Vector3(), step = 1e-3;
  const turned = new THREE.Matrix3().getNormalMatrix(node.matrixWorld);
  const places = new Float32Array(3 * place.count), normals = new Float32Array(3 * place.count);
  for (let i = 0; i < place.count; ++i) {
    node.getVertexPosition(i, p);
    if (normal) {
      n.fromBufferAttribute(normal, i);
      (geometry.morphAttributes.normal ?? []).forEach((m, k) => n.addScaledVector(q.fromBufferAttribute(m, i), node.morphTargetInfluences[k]));
      if (node.isSkinnedMesh) {
        q.fromBufferAttribute(place, i).addScaledVector(n, step);
        n.copy(node.applyBoneTransform(i, q)).sub(p);
      }
      n.applyMatrix3(turned).normalize().toArray(normals, 3 * i);
    }
    p.applyMatrix4(node.matrixWorld).toArray(places, 3 * i);
  }
  geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
  if (normal) geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3));
  geometry.morphAttributes = {};
  return geometry;
}

window.draw = async (url) => {
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  loader.setDRACOLoader(new DRACOLoader().setDecoderPath("/three/examples/jsm/libs/draco/gltf/"));
  const scene = (await loader.loadAsync(url)).scene, out = new THREE.Scene();
  scene.updateMatrixWorld(true);
  const inner = new THREE.MeshLambertMaterial({ color: new THREE.Color().setRGB(0.75, 0.3, 0.12), side: THREE.BackSide });
  scene.traverse((node) => {
    if (!node.isMesh) return;
    const add = (material) => {
      const moves = node.isSkinnedMesh || node.morphTargetInfluences?.some((w) => w !== 0);
      const mesh = new THREE.Mesh(moves ? posed(node) : node.geometry, material);
      if (!moves) mesh.applyMatrix4(node.matrixWorld);
      mesh.updateMatrixWorld(true);
      out.add(mesh);
    };
    for (let i = 0; i < (node.count ?? 1); ++i) {
      if (node.isInstancedMesh) {
        const at = new THREE.Matrix4();
        node.getMatrixAt(i, at);
        const mesh = new THREE.Mesh(node.geometry, plain(node.material));
        mesh.applyMatrix4(node.matrixWorld.clone().multiply(at));
        mesh.updateMatrixWorld(true);
        out.add(mesh);
      } else add(plain(node.material));
    }
    if (node.material.side !== THREE.DoubleSide && !node.isInstancedMesh) add(inner);
  });
  // As the corner view of facetmill, where y points up.
  const z = new THREE.Vector3(0.55, 0.45, 1).normalize(), x = new THREE.Vector3(0, 1, 0).cross(z).normalize(), y = z.clone().cross(x);
  const low = [1e30, 1e30, 1e30], high = [-1e30, -1e30, -1e30], p = new THREE.Vector3();
  out.traverse((node) => {
    const place = node.geometry?.attributes.position;
    for (let i = 0; place && i < place.count; ++i) {
      p.fromBufferAttribute(place, i).applyMatrix4(node.matrixWorld);
      [x, y, z].forEach((axis, k) => { const d = p.dot(axis); low[k] = Math.min(low[k], d); high[k] = Math.max(high[k], d); });
    }
  });
  const scale = Math.min(0.92 * width / (high[0] - low[0]), 0.92 * height / (high[1] - low[1]));
  const depth = high[2] - low[2] || 1, middle = [0, 1, 2].map((k) => (low[k] + high[k]) / 2);
  const camera = new THREE.OrthographicCamera(-width / scale / 2, width / scale / 2, height / scale / 2, -height / scale / 2, 0, 4 * depth);
  camera.matrixAutoUpdate = false;
  const eye = new THREE.Vector3().addScaledVector(x, middle[0]).addScaledVector(y, middle[1]).addScaledVector(z, high[2] + depth);
  camera.matrix.makeBasis(x, y, z).setPosition(eye);
  camera.updateMatrixWorld(true);
  out.add(new THREE.AmbientLight(0xffffff, 0.16 * Math.PI));
  const sun = new THREE.DirectionalLight(0xffffff, 0.84 * Math.PI);
  sun.position.set(0, 0, 0).addScaledVector(x, -0.35).addScaledVector(y, 0.55).addScaledVector(z, 0.75);
  out.add(sun);
  renderer.render(out, camera);
  return renderer.domElement.toDataURL("image/png");
};
window.ready = true;
</script>""".replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(HEIGHT))


def data_uri(kind, data):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


def checks():
    """A picture of letters' worth of asymmetry: a gradient with a dark corner and a hole in its alpha."""
    y, x = numpy.mgrid[0:64, 0:64]
    pixels = numpy.stack([x * 4, y * 4, 255 - x * 2 - y * 2, numpy.full_like(x, 255)], -1).astype(numpy.uint8)
    pixels[8:24, 8:24, :3] = 20
    pixels[36:56, 36:56, 3] = 0
    pixels[40:52, 4:20, 3] = 120
    data = io.BytesIO()
    Image.fromarray(pixels, "RGBA").save(data, "PNG")
    return data_uri("image/png", data.getvalue())


def square(material=None, sampler=None, info=None, uv=(-0.5, 1.7), second=False, colours=False):
    """A glTF file of a square seen from all sides, with a texture laid on."""
    low, high = uv
    places = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    arrays = {"POSITION": [f for p in places for f in p], "TEXCOORD_0": [low, high, high, high, high, low, low, low]}
    if second:
        arrays["TEXCOORD_1"] = [0, 0, 1, 0, 1, 1, 0, 1]
    if colours:
        arrays["COLOR_0"] = [1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]
    blob, views, accessors, attributes = struct.pack("<6H", 0, 1, 2, 0, 2, 3), [], [], {}
    views.append({"buffer": 0, "byteOffset": 0, "byteLength": 12})
    accessors.append({"bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR"})
    for name, values in arrays.items():
        data, size = struct.pack(f"<{len(values)}f", *values), len(values) // 4
        attributes[name] = len(accessors)
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(data)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5126, "count": 4, "type": f"VEC{size}"})
        if name == "POSITION":
            accessors[-1] |= {"min": [0, 0, 0], "max": [1, 1, 0]}
        blob += data
    return {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_texture_transform", "KHR_materials_unlit"],
            "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "rotation": [0, 0.2, 0, 0.98]}],
            "meshes": [{"primitives": [{"attributes": attributes, "indices": 0, "material": 0}]}],
            "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, **(info or {})}},
                           **(material or {})}],
            "textures": [{"source": 0, "sampler": 0}], "samplers": [sampler or {}], "images": [{"uri": checks()}],
            "buffers": [{"byteLength": len(blob), "uri": data_uri("application/octet-stream", blob)}],
            "bufferViews": views, "accessors": accessors}


def features():
    moved = {"extensions": {"KHR_texture_transform": {"offset": [0.3, 0.1], "rotation": 0.6, "scale": [1.5, 0.7]}}}
    base = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.3, 0.8, 0.5, 0.6]}}
    return {
        "wrap repeat": square(), "wrap clamp": square(sampler={"wrapS": 33071, "wrapT": 33071}),
        "wrap mirror": square(sampler={"wrapS": 33648, "wrapT": 33648}),
        "nearest": square(sampler={"magFilter": 9728, "minFilter": 9728}, uv=(0, 1)),
        "texture transform": square(info=moved), "second set": square(info={"texCoord": 1}, second=True),
        "alpha mask": square({"alphaMode": "MASK", "alphaCutoff": 0.4}), "alpha blend": square({"alphaMode": "BLEND"}),
        "factor": square({**base, "alphaMode": "BLEND"}), "unlit": square({"extensions": {"KHR_materials_unlit": {}}}),
        "emissive": square({"emissiveTexture": {"index": 0}, "emissiveFactor": [0.5, 0.1, 0.9]}),
        "vertex colours": square(colours=True),
        "many texels": square(uv=(-20, 20)),
    }


def on_ground(data):
    picture = numpy.asarray(Image.open(io.BytesIO(data)).convert("RGBA")).astype(float)
    alpha = picture[..., 3:] / 255
    return picture[..., :3] * alpha + GROUND * (1 - alpha)


def compared(a, b):
    similarity = structural_similarity(a, b, channel_axis=2, data_range=255, gaussian_weights=True, sigma=1.5,
                                       use_sample_covariance=False)
    return similarity, (numpy.abs(a - b).max(-1) > 16).mean()


def serve(folder):
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=folder)
    handler.log_message = lambda *_: None
    http.server.SimpleHTTPRequestHandler.log_message = lambda *_: None
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return f"http://127.0.0.1:{server.server_address[1]}"


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("files", nargs="*", type=pathlib.Path)
    ask.add_argument("--three", required=True, type=pathlib.Path, help="the folder of the npm package")
    ask.add_argument("--build", default=ROOT / "build/release", type=pathlib.Path)
    ask.add_argument("--pairs", type=pathlib.Path, help="keeps the pictures there")
    given = ask.parse_args()
    if given.pairs:
        given.pairs.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "three").symlink_to(given.three.resolve())
        (folder / "page.html").write_text(PAGE)
        files = {str(f): f.resolve() for f in given.files}
        for feature, document in features().items():
            files[feature] = folder / f"{feature}.gltf"
            files[feature].write_text(json.dumps(document))
        address = serve(name)
        print("| file | SSIM | pixels off by more than 16 |\n|---|---|---|")
        with Browser() as browser:
            browser.go(f"{address}/page.html")
            browser.wait("window.ready")
            for number, (what, path) in enumerate(files.items()):
                beside = folder / f"f{number}"
                beside.symlink_to(path.parent)
                own = folder / "own.png"
                output([given.build / "facetmill", "render", path, "-o", own, "-q", "--width", WIDTH, "--height", HEIGHT,
                        "--no-occlusion", "--edges", "no", "--normals", "auto"])
                theirs = browser.do(f"draw({json.dumps(f'/{beside.name}/{path.name}')})")
                a, b = on_ground(own.read_bytes()), on_ground(base64.b64decode(theirs.split(",")[1]))
                similarity, off = compared(a, b)
                label = pathlib.Path(what).name
                print(f"| {label} | {similarity:.3f} | {100 * off:.2f} % |", flush=True)
                if given.pairs:
                    pair = numpy.concatenate([a, b, numpy.abs(a - b)], 1).clip(0, 255).astype(numpy.uint8)
                    Image.fromarray(pair).save(given.pairs / f"{label.replace(' ', '-')}.png")


if __name__ == "__main__":
    main()
