// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CellGradient_h
#define tetralux_CellGradient_h

namespace tetralux
{

/// The gradient of a scalar that is linear in a tetrahedron, times its volume: nothing is divided,
/// so that flat cells have one, too.
struct CellGradient
{
  double Weighted[3];   ///< gradient times SixfoldVolume
  double SixfoldVolume; ///< at least 0, whatever the order of the points

  /// edges: from the first corner to the other three. rises: of the scalar along them.
  CellGradient(const double (&edges)[3][3], const double (&rises)[3])
  {
    // The normals of the three faces at the first corner, weighted by the rises of the
    // points across.
    double normals[3][3];
    for (int i = 0; i < 3; ++i)
    {
      const double* a = edges[(i + 1) % 3];
      const double* b = edges[(i + 2) % 3];
      normals[i][0] = a[1] * b[2] - a[2] * b[1];
      normals[i][1] = a[2] * b[0] - a[0] * b[2];
      normals[i][2] = a[0] * b[1] - a[1] * b[0];
    }
    const double volume =
      edges[0][0] * normals[0][0] + edges[0][1] * normals[0][1] + edges[0][2] * normals[0][2];
    const double sign = volume < 0 ? -1 : 1;
    for (int a = 0; a < 3; ++a)
    {
      this->Weighted[a] =
        sign * (rises[0] * normals[0][a] + rises[1] * normals[1][a] + rises[2] * normals[2][a]);
    }
    this->SixfoldVolume = sign * volume;
  }
};

} // namespace tetralux

#endif
