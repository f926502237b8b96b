# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView and the tool render, to be compared: data, cameras, colour maps, settings.

Plain data, since ParaView's Python and VTK's can't be imported by one process.
"""

SIZE = (240, 180)
BACKGROUND = (0.2, 0.4, 0.6)  # in 8 bits without rounding

# Scalar, red, green, blue; scalar, opacity, midpoint, sharpness, in fractions of the array's range.
COLORS = ((0, 0.1, 0.2, 0.9), (0.3, 0.2, 0.9, 0.4), (0.6, 1, 0.8, 0.2), (1, 0.8, 0.1, 0.1))
OPACITIES = ((0, 0, 0.5, 0), (0.25, 0.3, 0.5, 0), (0.5, 0.1, 0.5, 0), (1, 0.9, 0.5, 0))

# Of a file: its array, what it is of, the array's range, the view, and the unit distance.
DATA = {
    "fin": {
        "array": "Density",
        "of": "POINTS",
        "range": (0.2, 4.98),
        "position": (14, 12, 32),
        "focal_point": (3, 4, 2.5),
        "view_up": (0, 1, 0),
        "unit_distance": 0.4,
    },
    "disk": {
        "array": "Temp",
        "of": "POINTS",
        "range": (293, 913.5),
        "position": (20, 28, 17),
        "focal_point": (0, 0, 0.1),
        "view_up": (0, 0, 1),
        "unit_distance": 2,
    },
    # The same in two blocks of a composite.
    "blocks": {
        "array": "Temp",
        "of": "POINTS",
        "range": (293, 913.5),
        "position": (20, 28, 17),
        "focal_point": (0, 0, 0.1),
        "view_up": (0, 0, 1),
        "unit_distance": 2,
    },
    "can": {
        "array": "EQPS",
        "of": "CELLS",
        "range": (0, 1.2),
        "position": (4, 12, 14),
        "focal_point": (-3, 1, -16),
        "view_up": (0, 1, 0),
        "unit_distance": 1,
    },
    "neghip": {
        "array": "SLCImage",
        "of": "POINTS",
        "range": (0, 255),
        "position": (110, 80, 150),
        "focal_point": (32.5, 32.5, 32.5),
        "view_up": (0, 1, 0),
        "unit_distance": 10,
    },
}

# Each scene: data, representation, what is set of it in ParaView, options of the tool.
METHODS = {
    "Ray casting": "ray-cast",
    "Graphics card": "gpu-ray-cast",
    "Projection": "projection",
}
SCENES = {}
for data in ("fin", "disk", "can"):
    for label, method in METHODS.items():
        SCENES[f"{data}-{method}"] = (
            data,
            "Tetralux Volume",
            {"TetraluxMethod": label},
            ["--method", method],
        )
SCENES["disk-automatic"] = (
    "disk",
    "Tetralux Volume",
    {"TetraluxBlendMode": "Maximum intensity"},
    ["--set", "BlendMode=maximum-intensity"],
)
SCENES["blocks-ray-cast"] = (
    "blocks",
    "Tetralux Volume",
    {"TetraluxMethod": "Ray casting"},
    ["--method", "ray-cast"],
)
CROPPED = [
    *("--method", "ray-cast", "--set", "Cropping=on"),
    *("--set", "CroppingRegionPlanes=-5,5,1,6,0,4"),
]
SCENES["fin-cropped"] = (
    "fin",
    "Tetralux Volume",
    {
        "TetraluxMethod": "Ray casting",
        "TetraluxCropping": 1,
        "TetraluxCroppingRegionPlanes": [-5, 5, 1, 6, 0, 4],
    },
    CROPPED,
)
# A box shows the same as planes that crop.
SCENES["fin-clipped"] = (
    "fin",
    "Tetralux Volume",
    {
        "TetraluxMethod": "Ray casting",
        "TetraluxClip": "Box",
        "TetraluxClip.Position": [-5, 1, 0],
        "TetraluxClip.Length": [10, 5, 4],
    },
    CROPPED,
)
for data, values in (("fin", (1.5, 3)), ("disk", (400, 700))):
    SCENES[f"{data}-isosurface"] = (
        data,
        "Tetralux Isosurface",
        {"TetraluxIsosurfaces": list(values), "TetraluxMapOpacity": 1, "TetraluxShade": 1},
        ["--method", "isosurface", "--isovalues", ",".join(map(str, values))],
    )
SCENES["neghip-triangle-caster"] = (
    "neghip",
    "Tetralux Triangle Caster",
    {"TetraluxSampleDistance": 0.5},
    ["--method", "triangle-caster", "--set", "SampleDistance=0.5"],
)


# Scenes whose states are saved and loaded: each representation, and what has a proxy of its own.
WITH_STATES = ("disk-ray-cast", "fin-clipped", "fin-isosurface", "neghip-triangle-caster")

FILES = {"neghip": "neghip.vti", "blocks": "blocks.vtm"}


def get_file(data):
    return FILES.get(data, f"{data}.vtu")


def scale(points, array_range):
    """Points of a function at scalars, as one list."""
    low, high = array_range
    return [x for p in points for x in (low + p[0] * (high - low), *p[1:])]
