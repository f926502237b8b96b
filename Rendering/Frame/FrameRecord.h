// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrameRecord_h
#define tetralux_FrameRecord_h

#include "OpenGL/ContextResources.h"
#include "Report/Json.h"
#include "Report/OnceWarning.h"
#include "TetraluxRenderingModule.h"

#include "vtkIndent.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <ostream>
#include <string>
#include <vector>

class vtkAbstractVolumeMapper;
class vtkImageData;
class vtkRenderWindow;
class vtkRenderer;
class vtkVolume;
class vtkWindow;

namespace tetralux
{

struct MapperFrame;

/// What a mapper's last frame left behind, whatever the mapper renders: picture, statistics and the
/// estimated error. A picture that is on the graphics card goes with its window, and so does one
/// that was made on the processor. Invokes the events of frames, and gives each error and warning
/// of them once.
class TETRALUXRENDERING_EXPORT FrameRecord
{
public:
  /// mapper: has the input, the observers and the errors; must live as long.
  explicit FrameRecord(vtkAbstractVolumeMapper* mapper);
  ~FrameRecord();
  FrameRecord(const FrameRecord&) = delete;
  FrameRecord& operator=(const FrameRecord&) = delete;

  /// Brings the input up to date and calls draw, between VolumeMapperRenderStartEvent and
  /// VolumeMapperRenderEndEvent. Observers may change the pipeline meanwhile: mapper, renderer,
  /// window, volume and property live until the frame has ended, and draw holds what it reads. A
  /// frame that an observer asks for during another one is not drawn, with a warning. What draw
  /// throws becomes an error of one line, which is not given again until a frame succeeds; then
  /// nothing is left of the frame. A renderer without a window of OpenGL and a render pass that
  /// peels volumes are such errors. Draw is given a frame with this picture, and with progress by
  /// VolumeMapperRenderProgressEvent. seconds: receives what it took, before the second event;
  /// where the picture was kept, it stays what that took, as another one would.
  void Render(vtkRenderer* renderer, vtkVolume* volume,
    const std::function<void(MapperFrame&)>& draw, double& seconds);

  /// Invokes an event with a share of what is done, 0..1. Returns whether to go on: the window may
  /// abort.
  bool ReportProgress(vtkRenderWindow* window, unsigned long event, double fraction);

  /// Writes the statistics of a frame that was drawn or aborted: those that are the same for all
  /// mappers, with sections of the mapper between them, and the estimated error, which is the sum
  /// of the frame's errors. Warns where that is above MaximumError without that of coarse rays.
  /// seconds: of the stages before the drawing, by name. frameSeconds: of all. Where the picture
  /// was kept, all but the seconds are those of the frame that made it, and nothing was rebuilt.
  void Write(MapperFrame& frame, const std::vector<std::string>& rebuilt, Json seconds,
    double frameSeconds, const Json& sections);

  /// Of the last frame; empty before the first one, while one is drawn, after one that failed or
  /// was aborted, and once the window's context has ended or its resources were released.
  vtkImageData* GetPicture();
  const std::string& GetStatistics() const { return this->Statistics; }
  double GetErrorEstimate() const { return this->ErrorEstimate; }

  /// Whether what is in a window's context can be released now, with the picture. Not while a
  /// frame is drawn: then the mapper's ReleaseGraphicsResources is called when that has ended.
  bool MayRelease(vtkWindow* window);

  /// For PrintSelf.
  void PrintStatistics(std::ostream& os, vtkIndent indent) const;

  /// Whether the estimated error is at most this; true below what single precision reaches.
  /// further: an error that was found after the frame.
  bool IsErrorKept(double maximumError, double further = 0) const;

private:
  /// Returns whether the picture was kept.
  bool Draw(
    vtkRenderer* renderer, vtkVolume* volume, const std::function<void(MapperFrame&)>& draw);
  MapperFrame Begin(vtkRenderer* renderer, vtkVolume* volume);
  void Clear();
  void ClearPicture();
  void WarnOfError(const MapperFrame& frame);

  vtkAbstractVolumeMapper* Mapper;
  vtkNew<vtkImageData> Image;
  vtkNew<vtkImageData> NoImage;
  std::function<void(vtkImageData*)> ReadPicture; ///< into Image; empty: it is there
  bool HasPicture = false;
  double ErrorEstimate = 0;
  Json Sections; ///< of the frame that made the picture
  std::string Statistics = "{}";
  std::string LastError;
  OnceWarning ErrorWarning;
  bool Drawing = false;
  std::vector<vtkSmartPointer<vtkWindow>> ToRelease; ///< when the frame has ended
  ContextResources Context;                          ///< of the window that the picture is of
};

} // namespace tetralux

#endif
