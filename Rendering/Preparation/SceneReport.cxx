// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/SceneReport.h"

#include "Intake/LeftOutCells.h"
#include "Preparation/ScenePreparation.h"
#include "Report/IntegratorName.h"

#include <type_traits>

namespace tetralux
{
namespace
{

const char* GetModelName(OpticalModel model)
{
  switch (model)
  {
    case OpticalModel::EmissionOnly:
      return "emission only";
    case OpticalModel::AbsorptionOnly:
      return "absorption only";
    case OpticalModel::MaximumIntensity:
      return "maximum intensity";
    case OpticalModel::Isosurfaces:
      return "isosurfaces";
    default:
      return "emission and absorption";
  }
}

const char* GetFormatName(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return "8-bit";
    case TexelFormat::UNorm16:
      return "16-bit";
    case TexelFormat::Half:
      return "half";
    default:
      return "float";
  }
}

std::string GetIntegrationReason(const ScenePreparation& preparation, Integrator integrator)
{
  if (preparation.Scene.Optics.GetModel() != OpticalModel::EmissionAbsorption)
  {
    return "exact for this optical model";
  }
  if (integrator == Integrator::OpticalDepth)
  {
    return "all that is visible has one colour";
  }
  if (preparation.Scene.Mesh.HasCellScalars())
  {
    return "closed form: cells are constant";
  }
  if (integrator == Integrator::Components)
  {
    return "several components have no table";
  }
  if (preparation.GetTableUse() == TableUse::Never)
  {
    return "closed form: asked for";
  }
  return preparation.GetTable().GetReason();
}

} // namespace

void DescribeSeconds(const ScenePreparation& preparation, Json& seconds)
{
  const ScenePreparation::Record& last = preparation.GetLast();
  seconds["intake"] = last.IntakeSeconds;
  seconds["mesh"] = last.MeshSeconds;
  seconds["scalars"] = last.ScalarsSeconds;
  seconds["transfer_function"] = last.FunctionSeconds;
  seconds["table"] = last.TableSeconds;
}

Json DescribeInput(const ScenePreparation& preparation)
{
  const TetrahedraIntakeReport& intake = preparation.Intake;
  Json input;
  input["points"] = intake.NumberOfPoints;
  input["cells"] = intake.NumberOfCells;
  input["ghost_cells"] = intake.GhostCells;
  input["blanked_cells"] = intake.BlankedCells;
  input["lower_dimensional_cells"] = intake.LowerDimensionalCells;
  input["invalid_cells"] = intake.InvalidCells;
  input["folded_cells"] = intake.FoldedCells;
  input["skipped_cells"] = intake.GetNumberOfSkippedCells();
  input["skipped_cell_types"] = intake.DescribeSkippedCells();
  input["left_out"] =
    DescribeLeftOutCells(intake, preparation.Scene.Mesh.GetMesh()->GetRemovedCells());
  input["skipped_blocks"] = intake.SkippedBlocks;
  input["array"] = preparation.GetArrayName();
  input["components"] = preparation.GetNumberOfComponents();
  input["array_of"] = preparation.Scene.Mesh.HasCellScalars() ? "cells" : "points";
  return input;
}

Json DescribeTables(const ScenePreparation& preparation)
{
  const VolumeScene& scene = preparation.Scene;
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  const RemovedCells& removed = mesh.GetRemovedCells();
  Json removedCells;
  removedCells["invalid_point_ids"] = removed.InvalidPointIds;
  removedCells["non_finite_coordinates"] = removed.NonFiniteCoordinates;
  removedCells["repeated_points"] = removed.RepeatedPoints;
  removedCells["duplicates"] = removed.Duplicates;

  Json tables;
  tables["tetrahedra"] = mesh.GetNumberOfCells();
  tables["points"] = mesh.GetMesh().GetNumberOfPoints();
  tables["merged_points"] = preparation.GetNumberOfMergedPoints();
  tables["boundary_faces"] = mesh.GetNumberOfBoundaryFaces();
  tables["non_manifold_faces"] = mesh.GetNumberOfNonManifoldFaces();
  tables["components"] = mesh.GetNumberOfComponents();
  tables["blank_tetrahedra"] = scene.Mesh.GetNumberOfBlankCells();
  tables["removed_tetrahedra"] = removedCells;
  tables["transfer_function_nodes"] = scene.Optics.GetTransferFunction().Nodes.size();
  tables["transfer_function_intervals"] = scene.Optics.GetIntervalTable().Intervals.size();
  tables["bytes"] = mesh.GetTableSize();
  if (const Convexification* convex = mesh.GetConvexification())
  {
    tables["imaginary_cells"] = convex->GetNumberOfCells();
    tables["steiner_points"] = convex->GetNumberOfSteinerPoints();
    tables["convexification_seconds"] = convex->GetSeconds();
    tables["convexification_refusal"] = convex->Refusal;
  }
  return tables;
}

Json DescribeMemory(const ScenePreparation& preparation)
{
  const auto getBytes = [](const auto& values)
  { return values.capacity() * sizeof(typename std::decay_t<decltype(values)>::value_type); };
  const VolumeScene& scene = preparation.Scene;
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  const TetrahedralMesh& tetrahedra = mesh.GetMesh();
  const Convexification* convex = mesh.GetConvexification();
  const PreIntegrationTable* table = scene.Optics.GetTable();
  Json memory;
  memory["mesh"] = getBytes(tetrahedra.Points) + getBytes(tetrahedra.Cells) +
    getBytes(tetrahedra.OriginalPoints) + getBytes(tetrahedra.OriginalCells);
  std::size_t scalars = getBytes(scene.Mesh.GetScalars()) + getBytes(scene.Mesh.GetColorScalars());
  for (const std::vector<double>& other : scene.Mesh.GetOtherScalars())
  {
    scalars += getBytes(other);
  }
  memory["scalars"] = scalars;
  memory["walk_tables"] = mesh.GetTableSize();
  const WalkTables* visible = scene.GetVisibleTables();
  memory["visible_tables"] = visible ? getBytes(visible->Faces) + getBytes(visible->Entries) +
      getBytes(visible->Bvh.Nodes) + getBytes(visible->Bvh.Triangles)
                                     : 0;
  memory["visible_cells"] = getBytes(scene.GetVisibleCells());
  memory["cell_values"] = getBytes(scene.GetCellValues());
  memory["component_rows"] = getBytes(scene.GetComponentRows());
  memory["gradients"] =
    getBytes(scene.Mesh.GetPointGradients()) + getBytes(scene.Mesh.GetCellGradients());
  memory["imaginary_cells"] =
    convex ? getBytes(convex->Cells) + getBytes(convex->SteinerPoints) : 0;
  memory["pre_integration"] = table ? table->GetNumberOfBytes() : 0;
  return memory;
}

Json DescribeSegments(const ScenePreparation& preparation, Integrator integrator)
{
  const SceneOptics& optics = preparation.Scene.Optics;
  Json segments;
  segments["optical_model"] = GetModelName(optics.GetModel());
  segments["integration"] = GetName(integrator);
  segments["reason"] = GetIntegrationReason(preparation, integrator);
  if (const PreIntegrationTable* table = optics.GetTable())
  {
    segments["table_scalar_size"] = table->Scalars.GetSize();
    segments["table_length_size"] = table->Lengths.Size;
    segments["table_length_scale"] =
      table->Lengths.Scale == LengthScale::Linear ? "linear" : "logarithmic";
    segments["table_scalar_axis"] =
      table->Settings.Axis == ScalarAxis::Uniform ? "uniform" : "nodes";
    segments["table_format"] = GetFormatName(table->Settings.Format);
    segments["table_bytes"] = table->GetNumberOfBytes();
    segments["table_is_coarse"] = preparation.GetTable().IsCoarse();
  }
  return segments;
}

} // namespace tetralux
