// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRepresentation
 * @brief   what representations of unstructured grids by the mappers of Tetralux have in common
 *
 * Takes any vtkDataSet, or a composite of them, whose chosen blocks are appended. Cells are
 * rendered as they are. In a parallel run data that planes part stay where they are. Otherwise
 * ParaView distributes them anew, and cells are split into tetrahedra first, since those that touch
 * the border between two processes are cut at it: parts of a tetrahedron have the scalars of the
 * whole, parts of other cells do not.
 *
 * A frame of an interaction is that of the mapper, too; mappers for the processor cast fewer rays
 * for it. There is no other level of detail.
 *
 * @warning Of a composite, only arrays that all chosen blocks have can be shown. Ghost cells are
 * not rendered, nor do they take part in gradients: smooth shading takes its normals from the cells
 * that one process draws, which shows along a border between two.
 *
 * @sa vtkTetrahedraVolumeMapper
 */
#ifndef vtkTetrahedraRepresentation_h
#define vtkTetrahedraRepresentation_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkVolumeRepresentation.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDataArray;
class vtkDataObject;
class vtkImplicitFunction;
class vtkObject;
class vtkRenderWindow;
class vtkTetrahedraVolumeMapper;

class TETRALUXREPRESENTATIONS_EXPORT vtkTetrahedraRepresentation : public vtkVolumeRepresentation
{
public:
  vtkTypeMacro(vtkTetrahedraRepresentation, vtkVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set a property of the mappers by its name, as SetMapperProperty("MaximumError", 1e-4). Mappers
   * that do not have the property, or do not honour the value of an enumeration, keep theirs.
   */
  void SetMapperProperty(const char* name, double value);
  void SetMapperProperty(
    const char* name, double v0, double v1, double v2, double v3, double v4, double v5);
  ///@}

  ///@{
  /**
   * Of the volume property, see vtkVolumeProperty. Defaults 0 (off), 0, 1, 0 and 100.
   */
  void SetShade(int shade);
  void SetAmbient(double ambient);
  void SetDiffuse(double diffuse);
  void SetSpecular(double specular);
  void SetSpecularPower(double power);
  ///@}

  ///@{
  /**
   * Set the isovalues of surfaces, in units of the scalars. Default: one, 0.
   */
  void SetNumberOfIsosurfaces(int number);
  void SetIsosurfaceValue(int index, double value);
  ///@}

  /**
   * Set what is shown: what is inside of a vtkBox, or on the side that the normal of a vtkPlane
   * points away from. Default nullptr: everything.
   */
  void SetClipFunction(vtkImplicitFunction* function);

  ///@{
  /**
   * Set which blocks of a composite are shown, by selectors in an assembly. Default: all.
   */
  void SetActiveAssembly(const char* name);
  void AddBlockSelector(const char* selector);
  void RemoveAllBlockSelectors();
  ///@}

  enum DistributionType
  {
    AUTOMATIC_DISTRIBUTION,
    ALWAYS_DISTRIBUTED,
    NEVER_DISTRIBUTED
  };

  /**
   * Set whether ParaView distributes the data of a parallel run anew, by boxes. Default
   * AUTOMATIC_DISTRIBUTION.
   *
   * - AUTOMATIC_DISTRIBUTION: if no planes perpendicular to axes part the data of processes, or if
   *   some processes have no cells. Otherwise data stay where they are.
   * - ALWAYS_DISTRIBUTED: always.
   * - NEVER_DISTRIBUTED: never. Oblique planes order the processes, too, but opaque geometry of
   *   other representations may be hidden or shown in the wrong places then. If no planes part the
   *   data, the pictures of processes are composited in the order of the boxes around their data,
   *   which may be wrong; one warning says so.
   */
  void SetDistribution(int distribution);

  ///@{
  /**
   * Find the unit distance with which rays through the bounds of the data, in all directions alike,
   * have a mean optical depth of 1 with the opacities of now; to be called by all processes at
   * once. 0 if there are no data, or if all are transparent.
   */
  void MeasureUnitDistance();
  double GetMeasuredUnitDistance();
  ///@}

  /**
   * Return the statistics of the last frame of this process, as JSON, see
   * vtkTetrahedraVolumeMapper::GetStatistics. "{}" before the first frame. In a parallel run with
   * "composited", the bytes that all processes sent and the seconds that this one took, and with
   * "distributed", the bytes of data that ParaView distributed anew.
   */
  const char* GetStatistics();

  /**
   * Set whether it is shown in views.
   */
  void SetVisibility(bool visible) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

protected:
  vtkTetrahedraRepresentation();
  ~vtkTetrahedraRepresentation() override;

  /**
   * Register a mapper whose properties the panel sets; to be called in constructors.
   */
  void AddMapper(vtkTetrahedraVolumeMapper* mapper);

  /**
   * Return the mapper for the next frame, one of those that were added. Called when the window's
   * context is there and current.
   */
  virtual vtkTetrahedraVolumeMapper* ChooseMapper(vtkRenderWindow* window) = 0;

  /**
   * Prepare the chosen mapper for a frame: its array, and what else a subclass has.
   */
  virtual void UpdateMapper(vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input);

  /**
   * Let a mapper show an array: the magnitude or the component that the colour map shows. If there
   * is none of that name, nothing is drawn, and one warning says so.
   */
  void SelectArray(vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input, const std::string& name,
    int association, int mode, int component);

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkTetrahedraRepresentation(const vtkTetrahedraRepresentation&) = delete;
  void operator=(const vtkTetrahedraRepresentation&) = delete;

  void PlaceData();
  void UseMapper(vtkTetrahedraVolumeMapper* mapper);
  void OnFrame(vtkObject* renderer, unsigned long event, void* data);

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
