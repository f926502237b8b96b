# SPDX-License-Identifier: BSD-3-Clause
"""The picture of a mapper as numpy arrays."""


def picture(mapper):
    """Return (rgba, depth) of a mapper's last frame, as the rays gathered it, as float32 arrays.

    rgba has the shape (height, width, 4): premultiplied colours and opacity, without a background.
    depth has the shape (height, width): world units along the ray to its first contribution, -1 if
    it has none. The first row is the bottom one. Both are copies, which the next frame leaves as
    they are. They are empty before the first frame, after one that failed or was aborted, and once
    the mapper's window was closed. Needs numpy.
    """
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy

    image = mapper.GetOutputImage()
    width, height, _ = image.GetDimensions()
    points = image.GetPointData()
    rgba, depth = points.GetArray("RGBA"), points.GetArray("Depth")
    if rgba is None or depth is None:
        return numpy.zeros((0, 0, 4), numpy.float32), numpy.zeros((0, 0), numpy.float32)
    return (
        vtk_to_numpy(rgba).reshape(height, width, 4).copy(),
        vtk_to_numpy(depth).reshape(height, width).copy(),
    )
