# SPDX-License-Identifier: BSD-3-Clause
"""What mappers say that they hold is what the process grows by. Each mapper in its own process."""

import ctypes
import json
import os
import subprocess
import sys

import numpy
import tetralux
from mapper_scene import MapperScene, get_points, make_property, make_unit_cube, set_scalars

MAPPERS = {
    "vtkTetrahedraRayCastMapper": (),
    "vtkTetrahedraGPURayCastMapper": ("card_mesh", "card_integral", "card_rays"),
    "vtkTetrahedraProjectionMapper": ("screen_points", "order", "projected_cells", "card_cells"),
    "vtkTetrahedraIsosurfaceMapper": ("isosurface_trees", "isosurface_steps"),
}
VOXELS = 48  # along an edge, each of five tetrahedra

# Bytes that a process may grow by beside what is named: what Mesa makes of two parts of cells, a
# picture, and memory that the C library keeps though it was freed.
UNNAMED = 30e6

# The share of what is named that may not be in memory: pages that nothing was written to yet.
UNUSED = 0.15


def read_resident():
    """Bytes of this process that are in memory, without those that were freed."""
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm", encoding="utf-8") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def make_image(voxels):
    image = make_unit_cube()
    image.SetDimensions(voxels + 1, voxels + 1, voxels + 1)
    image.SetSpacing(1 / voxels, 1 / voxels, 1 / voxels)
    set_scalars(image, "x", get_points(image)[:, 0].astype(numpy.float32))
    return image


def measure(name):
    """Prints what a frame adds to the memory of the process, and what the mapper names."""
    mapper = getattr(tetralux, name)()
    mapper.SetInputData(make_image(2))
    volume_property = make_property([(0, 1, 0, 0), (1, 0, 1, 0)], [(0, 0.1), (1, 0.5)])
    volume_property.GetIsoSurfaceValues().SetValue(0, 0.3)
    scene = MapperScene(mapper, volume_property, 128, 128)
    scene.look_at_unit_cube()
    scene.render()  # what OpenGL and its shaders take is not the mesh's
    image = make_image(VOXELS)
    before = read_resident()
    mapper.SetInputData(image)
    statistics = scene.render()[2]
    scene.window.WaitForCompletion()
    print(
        json.dumps(
            {
                "grown": read_resident() - before,
                "memory": statistics["memory"],
                "peaks": statistics["memory_peaks"],
                "process": statistics["process_peaks"],
            }
        )
    )


def main():
    for name, parts in MAPPERS.items():
        run = subprocess.run(
            [sys.executable, __file__, name], check=True, capture_output=True, text=True
        )
        found = json.loads(run.stdout.splitlines()[-1])
        memory = found["memory"]
        named = sum(memory.values())
        print(name, {"grown": found["grown"], "named": named}, memory)
        for part in ("mesh", "scalars", "walk_tables", *parts):
            assert memory[part] > 0, (name, part)
        for part, held in memory.items():
            assert found["peaks"][part] >= held, (name, part)
        assert memory["mesh"] < 27 * 5 * VOXELS**3, "ids have 32 bits"
        assert found["grown"] > (1 - UNUSED) * named, name
        assert found["grown"] < named + UNNAMED, name
        process = list(found["process"].values())
        assert process == sorted(process), (name, found["process"])


if __name__ == "__main__":
    measure(sys.argv[1]) if len(sys.argv) > 1 else main()
