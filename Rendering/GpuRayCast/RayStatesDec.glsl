// SPDX-License-Identifier: BSD-3-Clause
// What the last number of a ray's state may be, other than the index of a face.

const int RayIsDone = -1;
const int RayNeedsEntry = -2; // it has not come into the mesh yet, or left it

// Instead of a boundary entry: there is none; or, below, which displacement the ray is to start
// anew with, see View/RayDisplacements.h.
const int NoEntry = -1;

// The last number of a ray's entries: whether its walk is to tell only, and its displacement.
int PackFlags(bool tells, int displacement)
{
  return 2 * displacement + int(tells);
}
bool GetTells(int flags)
{
  return (flags & 1) != 0;
}
int GetDisplacement(int flags)
{
  return flags >> 1;
}

const float LargestFloat = 3.402823e38;
