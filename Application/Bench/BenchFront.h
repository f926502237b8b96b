// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchFront_h
#define BenchFront_h

struct BenchSceneResult;

/// Marks the rows of the Pareto front of largest error and best time: those that no other row
/// beats. A row beats another if it is better in one of the two and not worse in the other. The
/// reference and failed rows take no part.
void MarkFront(BenchSceneResult& result);

#endif
