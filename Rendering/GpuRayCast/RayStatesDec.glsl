// SPDX-License-Identifier: BSD-3-Clause
// What the last number of a ray's state may be, other than the index of a face.

const int RayIsDone = -1;
const int RayNeedsEntry = -2; // it has not come into the mesh yet, or left it

const float LargestFloat = 3.402823e38;
