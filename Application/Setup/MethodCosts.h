// SPDX-License-Identifier: BSD-3-Clause
#ifndef MethodCosts_h
#define MethodCosts_h

#include "Setup/Methods.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;

/// What the time of a picture depends on.
struct PictureWork
{
  std::int64_t Tetrahedra = 0;
  int Width = 0;
  int Height = 0;
};

/// Tells about how many tetrahedra there are, without making them.
std::int64_t EstimateTetrahedra(vtkDataObject* data);

/// Predicts the seconds until a graphics card has drawn the first picture of a mesh: what the
/// processor prepares, and what the card draws. method: "gpu-ray-cast" or "projection". The mesh is
/// taken to fill the picture, to be about as deep as it is wide, and to let each ray in once.
double PredictSeconds(const std::string& method, const PictureWork& work);

/// Moves projection before gpu-ray-cast if it is predicted to take less time, else behind it, and
/// adds both times to their reasons. Does nothing if not both are there.
void RankMethods(const PictureWork& work, std::vector<MethodChoice>& methods);

#endif
