# SPDX-License-Identifier: Apache-2.0
"""The structs of Python have the layout that a C or C++ compiler gives those of the headers."""

import ctypes
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import sobb
from sobb import format, structs

ROOT = Path(__file__).resolve().parents[3]
INCLUDE = ROOT / "capi" / "include"

STRUCTS = {
    "sobb_triangles": structs.Triangles,
    "sobb_build_options": structs.BuildOptions,
    "sobb_open_options": structs.OpenOptions,
    "sobb_trace_options": structs.TraceOptions,
    "sobb_info": structs.HierarchyInfo,
    "sobb_scene_options": structs.SceneOptions,
    "sobb_scene_info": structs.SceneInfo,
    "sobb_mesh": structs.SceneMesh,
    "sobb_view": structs.SceneView,
}
DTYPES = {
    "sobb_ray": sobb.ray_dtype,
    "sobb_hit": sobb.hit_dtype,
    "sobb_count": sobb.count_dtype,
}
FILE_DTYPES = {
    "FileHeader": format.header_dtype,
    "Section": format.section_dtype,
    "BuildRecord": format.record_dtype,
    "TriangleBlock": format.block_dtype,
    "Node<4>": format.node_dtype(4),
    "Node<8>": format.node_dtype(8),
}


def struct_layout(struct):
    members = {name: getattr(struct, name).offset for name, _ in struct._fields_}
    return ctypes.sizeof(struct), members


def dtype_layout(dtype):
    return dtype.itemsize, {name: dtype.fields[name][1] for name in dtype.names}


def compiled_layout(folder, expected, prologue, compiler, language):
    """The layouts of the types of `expected` as a C or C++ compiler sees them."""
    lines = [prologue, "#include <stddef.h>", "#include <stdio.h>", "int main(void) {"]
    for name, (_, members) in expected.items():
        lines.append(f'printf("{name} %zu", sizeof({name}));')
        lines += [f'printf(" {m} %zu", offsetof({name}, {m}));' for m in members]
        lines.append('printf("\\n");')
    source = folder / f"layout.{language}"
    source.write_text("\n".join([*lines, "return 0;", "}"]))
    program = folder / f"layout-{language}"
    includes = [f"-I{INCLUDE}", f"-I{ROOT / 'lib'}"]
    standard = ["-std=c++20"] if language == "cpp" else ["-std=c99"]
    subprocess.run([compiler, *standard, *includes, str(source), "-o", str(program)], check=True)
    out = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout
    layouts = {}
    for line in out.splitlines():
        name, size, *members = line.split()
        pairs = zip(members[::2], map(int, members[1::2]), strict=True)
        layouts[name] = int(size), dict(pairs)
    return layouts


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_structs_are_those_of_the_header(tmp_path):
    expected = {name: struct_layout(struct) for name, struct in STRUCTS.items()}
    expected |= {name: dtype_layout(dtype) for name, dtype in DTYPES.items()}
    prologue = '#include "sobb/scene.h"'
    assert compiled_layout(tmp_path, expected, prologue, "cc", "c") == expected


@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
def test_file_types_are_those_of_the_library(tmp_path):
    expected = {name: dtype_layout(dtype) for name, dtype in FILE_DTYPES.items()}
    prologue = '#include "format/layout.h"\nusing namespace sobb;'
    assert compiled_layout(tmp_path, expected, prologue, "c++", "cpp") == expected


def test_sizes():
    assert sobb.ray_dtype.itemsize == 32
    assert sobb.hit_dtype.itemsize == 24
    assert sobb.count_dtype.itemsize == 16


def test_statuses_are_those_of_the_header():
    text = (INCLUDE / "sobb" / "sobb.h").read_text()
    found = re.findall(r"SOBB_(?:ERROR_)?(\w+) = (\d+),?\s+/\*\*<", text)
    names = {status.name: status.value for status in sobb.Status if status != sobb.Status.OK}
    in_header = {name: int(value) for name, value in found}
    assert names.items() <= in_header.items()
    errors = re.findall(r"SOBB_ERROR_(\w+) = ", text)
    assert set(errors) == set(names)
