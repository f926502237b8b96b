// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PointMerger_h
#define tetralux_PointMerger_h

#include "Intake/ScalarExtraction.h"
#include "Mesh/CoincidentPoints.h"
#include "Preparation/MapperSettings.h"
#include "TetraluxRenderingModule.h"

#include <cstdint>
#include <optional>

class vtkDataObject;

namespace tetralux
{

class WalkMesh;

/// Which points of an input are taken as one: those at the same place whose scalars agree, so that
/// the cells around them become neighbours.
class TETRALUXRENDERING_EXPORT PointMerger
{
public:
  /// The cells of the input were taken in anew; mesh: as they are. If nearly each cell has points
  /// of its own, coincident ones are looked for at once: tables of such a mesh are large.
  void Start(PointMerging merging, vtkDataObject* input, const TetrahedralMesh& mesh);

  /// Whether it is known which points coincide. If it is not, Find looks for them among the points
  /// of the boundary: where cells share their points there are few of them.
  bool HasFound() const { return this->Found.has_value(); }
  void Find(vtkDataObject* input, const WalkMesh& mesh);

  /// The points that the mesh takes as one; none after Start.
  const CoincidentPoints& GetMerged() const { return this->Merged; }

  /// After Start found points and Accept refused to merge them; mesh: without merged points. If it
  /// does not fit together either, merging is not to blame.
  void CompareWith(const WalkMesh& mesh);

  /// The points of the input have moved. Returns false if merged ones came apart, so that the mesh
  /// has to be made anew. If none are merged, what was found is forgotten.
  bool Follow(vtkDataObject* input);

  /// The points to merge, of those that were found.
  CoincidentPoints Choose(
    PointMerging merging, vtkDataObject* input, const ScalarSelection& selection) const;

  /// Takes note of a mesh of other merged points. Returns whether it is to be used:
  /// PointMerging::Automatic refuses a mesh in which merging makes cells the same, or lets more
  /// than two share a face, as where cells overlap.
  bool Accept(PointMerging merging, const CoincidentPoints& merged, const WalkMesh& mesh);

private:
  std::optional<CoincidentPoints> Found; ///< once they were looked for
  std::int64_t Misfits = 0;              ///< of the mesh without merged points
  std::int64_t MergedMisfits = 0;        ///< of a mesh in which all that was found is merged
  bool Fits = true;                      ///< false once a mesh of all that was found was refused
  CoincidentPoints Merged;
};

} // namespace tetralux

#endif
