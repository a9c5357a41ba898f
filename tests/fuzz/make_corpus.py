#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the part of the corpus that comes from built-in scenes (see README.md).

usage: tests/fuzz/make_corpus.py FOLDER     with the Python package sobb importable
"""

import base64
import json
import struct
import sys
from pathlib import Path

import numpy as np

import sobb

NAMES = "hairball", "wool", "pipes", "foliage", "city", "terrain"

# A grid of three by three squares, as the encoders of libdraco and libmeshoptimizer write it. Of
# Draco's, "valence" and "one-part" have normals and texture coordinates too.
DRACO = {
    "edgebreaker": (
        "RFJBQ08CAgEBAAAAEBIAEgIABu/T6lOtGv8BEQH/AAABAAkDAAACAQEBAQKsAQEw//+frQYBCFUBCZ5NFVVY0q"
        "O/nAAAAAD/AAAAAAAAAAAAAAAAAAAAAABAQAg="
    ),
    "valence": (
        "RFJBQ08CAgEBAAAAEBICEgIABu/T6lOtGv8BEf8Ca0H/AmtBA/8AAQAAAAEAAAEACQMAAAIBAQkDAAEDAQMJAg"
        "ACAgEBAQEFrAEBMP//n60GAQhVAQmeTRVVWNKjv5wAAAAA/wAAAAAAAAAAAAAAAAAAAAAAQEAIBgMBAAcDARAP"
        "ATAEALxDhxAfLwLyHjHy8iLGbMzKOhuzsSo/AAAAHwAAAP8CEUEGBQEBAAcDARgHAQgBGAEIBgACSGe+h+qqpt"
        "1m2gHBsMNO0wAADgAAABID+DCCAAAAAD8AAAAAAAAAAAAAAAAAQEAG"
    ),
    "one-part": (
        "RFJBQ08CAgEBAAAAEBIAEgIABu/T6lOtGv8BEQH/AAADAAkDAAABCQMAAQMJAgACAgMCAAEBAQGtAVUVA1UB//"
        "+XVRFdFVUBVQEO5guBxJ427QvfSz9DzoQAAAAA/wAAAAADAQEBIAE+dwECAwC/kz8AAAAfAAAAAAEBAQEtARAD"
        "AQKXARIBGAECAQIKgI2/am4aOGKfTgAAAAA/AAAAAAAAAAAAAAAAAAAAAABAQAgGAAAAAAAAAAAAAEBABg=="
    ),
    "sequential": (
        "RFJBQ08CAgEAAAASEAEAAQICAQMBBAMDBAUEBgUFBgcCAwgIAwkDBQkJBQoFBwoKBwsICQwMCQ0JCg0NCg4KCw"
        "4OCw8BAQAJAwAAAgABAQEDqwGtGgOtAv//l1UJVRkMZiwo8vRv/H7PydOtAAAAAP8AAAAAAAAAAAAAAAAAAAAA"
        "AEBACA=="
    ),
}
MESHOPT = {
    "ATTRIBUTES": (
        "oAAAAwD//4B///+Af///gH///4ABOPj4+H5/fn9+f34AAAEAwMDA//+AAQDAgAB+AAABM8888/////////////"
        "8BM8888359fn1+fX59fn0AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA=="
    ),
    "TRIANGLES": "4P4fEA8QD48fFA8TD48fEw8TDw8IAgICAgICAgICAgIAdodWZ3iphmWJaJgBaQAA",
    "INDICES": "0AAEDAAKEA4EDAAKEA4EDAAKEAoEDAAKEA4EDAAKEA4EDAAKEAoEDAAKEA4EDAAKEA4EDAAKEAAAAAA=",
}


def hierarchies():
    """Small .sobb files of every volume, width and k, from one scene after another."""
    for i, (volume, width, k) in enumerate(
        (v, w, k) for v, ks in (("aabb", (64,)), ("sobb", (32, 48, 64))) for w in (4, 8) for k in ks
    ):
        name = NAMES[i % len(NAMES)]
        with sobb.build(*part(name, 24), volume=volume, width=width, k=k) as hierarchy:
            yield f"{name}-{volume}-{width}-{k}.sobb", bytes(hierarchy.bytes)
    # With spatial splits, and deep enough for inner nodes.
    for width in (4, 8):
        with sobb.build(*part("city", 100), width=width, quality="high") as hierarchy:
            yield f"city-high-{width}.sobb", bytes(hierarchy.bytes)


def part(name, triangles):
    """The first triangles of a built-in scene, with the vertices that they use."""
    with sobb.Scene.load(f"builtin:{name}:1000") as scene:
        used, faces = np.unique(scene.faces[:triangles], return_inverse=True)
        return np.array(scene.vertices[used]), faces.reshape(-1, 3).astype(np.uint32)


def lines(*items):
    return "".join(f"{item}\n" for item in items).encode()


def row(values):
    return " ".join(f"{v:.5g}" for v in values)


def obj(v, f):
    yield "plain.obj", lines("o part", *("v " + row(p) for p in v), *("f " + row(t + 1) for t in f))
    yield (
        "relative.obj",
        lines(
            "# all kinds of corners",
            "mtllib x.mtl",
            *("v " + row(p) + " 1.0" for p in v[:4]),
            "vt 0 0",
            "vn 0 0 1",
            "g a b",
            "f -4//1 -3/1 -2/1/1 -1",
            "f 1 2 \\",
            "  3",
            "usemtl m",
            "s off",
        ),
    )
    triangle = ["v 0 0 0", "v 1 0 0", "v 0 1 0"]
    yield "large-face.obj", lines(*triangle, "f" + " 1" * 6000)
    yield "large-groups.obj", lines(*triangle, *["g x", "f 1 2 3"] * 1000)


def off(v, f):
    header = f"{len(v)} {len(f)} 0"
    faces = ["3 " + row(t) for t in f]
    yield "plain.off", lines("OFF", header, *map(row, v), *faces)
    yield "colour.off", lines("COFF " + header, *(row(p) + " 255 0 0 255" for p in v), *faces)
    vertices = [row(p) + " 0 0 1" for p in v]
    yield (
        "normal.off",
        lines("NOFF", "# c", header, *vertices, *(t + " 0.5 0.5 0.5" for t in faces)),
    )


def ply(v, f):
    def header(form, vertex, face):
        return lines("ply", f"format {form} 1.0", "comment c", f"element vertex {len(v)}",
                     *(f"property {vertex} {a}" for a in "xyz"), f"element face {len(f)}",
                     f"property list {face} vertex_indices", "end_header")  # fmt: skip

    faces = lines(*("3 " + row(t) for t in f))
    yield "ascii.ply", header("ascii", "float", "uchar int") + lines(*map(row, v)) + faces
    for name, form, order in (
        ("little", "binary_little_endian", "<"),
        ("big", "binary_big_endian", ">"),
    ):
        body = v.astype(order + "f4").tobytes()
        body += b"".join(b"\x03" + t.astype(order + "u4").tobytes() for t in f)
        yield f"{name}.ply", header(form, "float32", "uint8 uint32") + body
    extra = lines("ply", "format binary_little_endian 1.0", "element face 1",
                  "property list ushort ushort vertex_index", "property uchar red",
                  "element vertex 3", "property double x", "property short s",
                  "property double y", "property double z", "property list uchar char l",
                  "end_header")  # fmt: skip
    body = struct.pack("<HHHHB", 3, 0, 1, 2, 9)
    for i in range(3):
        body += struct.pack("<dhddB2b", i, -1, i * i, 1, 2, 5, 6)
    yield "faces-first.ply", extra + body


def stl(v, f):
    body = b"".join(struct.pack("<3f", 0, 0, 1) + v[t].astype("<f4").tobytes() + b"\0\0" for t in f)
    yield "binary.stl", b"made by make_corpus".ljust(80) + struct.pack("<I", len(f)) + body
    facets = []
    for t in f[:6]:
        facets += ["facet normal 0 0 1", "outer loop", *("vertex " + row(v[i]) for i in t)]
        facets += ["endloop", "endfacet"]
    yield "ascii.stl", lines("solid name", *facets, "endsolid name")


def document(v, f, uri):
    """A glTF with nodes of every kind, a camera, a strip, a fan, sparse accessors, targets."""
    buffer = v.astype("<f4").tobytes() + f.astype("<u2").tobytes() + bytes([0, 2, 5])
    indices = f.size
    gltf = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 3, 4]}],
        "nodes": [
            {"name": "root", "children": [1, 2], "translation": [1, 2, 3]},
            {"mesh": 0, "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, 1]},
            {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
            {"mesh": 1, "weights": [0.5, 0, 2]},
            {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}},
        ],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "meshes": [
            {"name": "m", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
            {
                "primitives": [
                    {"attributes": {"POSITION": 0}, "mode": 5},
                    {
                        "attributes": {"POSITION": 2},
                        "mode": 6,
                        "targets": [{"POSITION": 2}, {"NORMAL": 0}, {"POSITION": 2}],
                    },
                    {"attributes": {"POSITION": 0}, "indices": 3},
                ],
                "weights": [1, 1, 1],
            },
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(v), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": indices, "type": "SCALAR"},
            {
                "componentType": 5126,
                "count": 4,
                "type": "VEC3",
                "sparse": {
                    "count": 2,
                    "indices": {"bufferView": 1, "componentType": 5123},
                    "values": {"bufferView": 0},
                },
            },
            {
                "componentType": 5123,
                "count": 6,
                "type": "SCALAR",
                "sparse": {
                    "count": 3,
                    "indices": {"bufferView": 2, "componentType": 5121},
                    "values": {"bufferView": 1},
                },
            },
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": v.size * 4, "byteStride": 12},
            {"buffer": 0, "byteOffset": v.size * 4, "byteLength": indices * 2},
            {"buffer": 0, "byteOffset": v.size * 4 + indices * 2, "byteLength": 3},
        ],
        "buffers": [{"byteLength": len(buffer)}],
        "materials": [{"name": "left out"}],
    }
    if uri:
        data = base64.b64encode(buffer).decode()
        gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + data
    return json.dumps(gltf, separators=(",", ":")).encode(), buffer


def gltf(v, f):
    yield "embedded.gltf", document(v, f, uri=True)[0]
    # Small files that are large in memory: in the parser's tree, in TinyGLTF's structs, in ours.
    for name, list_of, element in (
        ("tree-objects", "extras", '{"a":1}'),
        ("tree-arrays", "extras", "[]"),
        ("nodes", "nodes", "{}"),
        ("cameras", "nodes", '{"camera":0}'),
        ("children", "nodes", '{"children":[1]}'),
        ("accessors", "accessors", '{"componentType":5126,"count":9,"type":"VEC3"}'),
    ):
        camera = '{"type":"perspective","perspective":{"yfov":1,"znear":1}}'
        head = f'{{"asset":{{"version":"2.0"}},"cameras":[{camera}],'
        elements = ",".join([element] * (12000 // (len(element) + 1)))
        yield f"large-{name}.gltf", f'{head}"{list_of}":[{elements}]}}'.encode()
    zeros = {"componentType": 5126, "count": 50000, "type": "VEC3"}
    large = {
        "asset": {"version": "2.0"},
        "accessors": [zeros] * 20,
        "meshes": [{"primitives": [{"attributes": {"POSITION": i}}]} for i in range(20)],
    }
    yield "large-zeros.gltf", json.dumps(large).encode()
    large["accessors"] = [zeros | {"count": 30}]
    large["meshes"] = [{"name": "n" * 4000, "primitives": [{"attributes": {"POSITION": 0}}]}]
    large["nodes"] = [{"mesh": 0}] * 800
    yield "large-names.gltf", json.dumps(large, separators=(",", ":")).encode()


def compressed(views, primitive):
    """A glTF of one primitive. Each of `views` is a view's extension, if any, and its bytes."""
    buffer = b"".join(data for _, data in views)
    offsets = [sum(len(data) for _, data in views[:i]) for i in range(len(views))]
    gltf = {
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1} | primitive]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 16, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 54, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": at, "byteLength": len(data)}
            | (
                {
                    "extensions": {
                        "EXT_meshopt_compression": extension
                        | {"buffer": 0, "byteOffset": at, "byteLength": len(data)}
                    }
                }
                if extension
                else {}
            )
            for at, (extension, data) in zip(offsets, views, strict=True)
        ],
        "buffers": [{"byteLength": len(buffer)}],
    }
    return json.dumps(gltf, separators=(",", ":")).encode() + b"\0" + buffer


def compressions():
    for name, data in DRACO.items():
        extension = {"bufferView": 0, "attributes": {"POSITION": 0}}
        primitive = {"extensions": {"KHR_draco_mesh_compression": extension}}
        yield f"draco-{name}", compressed([({}, base64.b64decode(data))], primitive)
    for mode in ("TRIANGLES", "INDICES"):
        views = [
            ({"byteStride": stride, "count": count, "mode": kind}, base64.b64decode(MESHOPT[kind]))
            for kind, stride, count in (("ATTRIBUTES", 12, 16), (mode, 2, 54))
        ]
        yield f"meshopt-{mode.lower()}", compressed(views, {})


def glb(v, f):
    text, buffer = document(v, f, uri=False)
    text += b" " * (-len(text) % 4)
    buffer += b"\0" * (-len(buffer) % 4)
    yield "parts", text + b"\0" + buffer
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(buffer), 0x004E4942) + buffer
    yield "whole.glb", struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
    yield from compressions()


def views():
    yield "large.json", ('{"other":[' + ",".join(["[]"] * 4000) + "]}").encode()
    view = {"eye": [1, 2, 3.5], "target": [0, 0, 0], "up": [0, 1, 0], "vfov_degrees": 50}
    yield "two.json", json.dumps({"scene": [view, view | {"up": [0, 0, 1]}], "other": []}).encode()


def main(folder):
    def write(seeds, items):
        (folder / seeds).mkdir(parents=True, exist_ok=True)
        for name, content in items:
            (folder / seeds / name).write_bytes(content)

    write("sobb", hierarchies())
    v, f = part("city", 24)
    for target, make in (("obj", obj), ("ply", ply), ("stl", stl), ("off", off), ("gltf", gltf),
                         ("glb", glb)):  # fmt: skip
        write(target, make(v, f))
    write("views", views())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
