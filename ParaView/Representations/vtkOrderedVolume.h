// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOrderedVolume
 * @brief   a volume of which several processes have parts, composited in float
 *
 * Stands in a renderer in place of a volume. In a parallel run each process draws its part into a
 * picture of floats, and the nearest process of ParaView's partition shows them all, composited in
 * the order of that partition or of planes between the data. Opaque geometry of any process hides
 * what is behind it. ParaView composites what is shown in 8 bits, as it does all else; where one
 * process shows it all, that changes nothing.
 *
 * In a run of one process, and where ParaView composites without an order or for several displays,
 * it draws the volume as it is.
 */
#ifndef vtkOrderedVolume_h
#define vtkOrderedVolume_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkProp.h"
#include "vtkSmartPointer.h" // For vtkSmartPointer

#include <memory> // For std::unique_ptr

class vtkRenderer;
class vtkVolume;

namespace tetralux
{
class SeparatingPlanes;
}

class TETRALUXREPRESENTATIONS_EXPORT vtkOrderedVolume : public vtkProp
{
public:
  static vtkOrderedVolume* New();
  vtkTypeMacro(vtkOrderedVolume, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Set the part of this process. Where it is not visible, the process has no part in the picture.
   */
  void SetVolume(vtkVolume* volume);

  /**
   * Set the planes that order the processes, in coordinates of the data. Default nullptr: the
   * partition of ParaView does.
   */
  void SetPlanes(std::shared_ptr<const tetralux::SeparatingPlanes> planes);

  /**
   * Prepare the next frame; to be called by all processes of a parallel run at once. distributed:
   * bytes of data that this process draws and that ParaView distributed anew.
   */
  void PrepareFrame(vtkRenderer* renderer, double distributed);

  ///@{
  /**
   * Return what the last frame cost: bytes that all processes sent for it together, and seconds
   * that this one took for compositing, waiting for others included. 0 in a run of one process.
   */
  vtkTypeInt64 GetNumberOfBytes() const;
  double GetSeconds() const;
  ///@}

  /**
   * Return the bytes of data that ParaView distributed anew before they were drawn, of all
   * processes together.
   */
  vtkTypeInt64 GetNumberOfDistributedBytes() const;

  double* GetBounds() override;
  void GetVolumes(vtkPropCollection* volumes) override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  void SetAllocatedRenderTime(double seconds, vtkViewport* viewport) override;
  vtkMTimeType GetRedrawMTime() override;

protected:
  vtkOrderedVolume();
  ~vtkOrderedVolume() override;

private:
  vtkOrderedVolume(const vtkOrderedVolume&) = delete;
  void operator=(const vtkOrderedVolume&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
