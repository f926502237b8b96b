// SPDX-License-Identifier: BSD-3-Clause
#include "ImageTester.h"

#include "vtkAlgorithm.h"
#include "vtkImageDifference.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"

#include <vtksys/SystemTools.hxx>

#include <string>

vtkStandardNewMacro(ImageTester);

int ImageTester::RegressionTest(vtkAlgorithm* imageSource, double threshold, ostream& os)
{
  // Also answers if the baseline is missing or of another size.
  const int result = this->Superclass::RegressionTest(imageSource, threshold, os);
  if (result != PASSED)
  {
    return result;
  }

  const std::string baseline = this->GetValidImageFileName();
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(baseline.c_str());
  vtkNew<vtkImageDifference> difference;
  difference->SetInputConnection(imageSource->GetOutputPort());
  difference->SetImageConnection(reader->GetOutputPort());
  difference->AllowShiftOff();
  difference->AveragingOff();
  difference->SetThreshold(ChannelTolerance);
  difference->Update();
  this->ImageDifference = difference->GetThresholdedError();
  os << "\nPixels that differ: " << this->ImageDifference << ", " << threshold << " may\n";
  if (this->ImageDifference <= threshold)
  {
    return PASSED;
  }

  const std::string stem = std::string(this->GetTempDirectory()) + "/" +
    vtksys::SystemTools::GetFilenameWithoutExtension(baseline);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(imageSource->GetOutputPort());
  writer->SetFileName((stem + ".png").c_str());
  writer->Write();
  writer->SetInputConnection(difference->GetOutputPort());
  writer->SetFileName((stem + ".diff.png").c_str());
  writer->Write();
  os << "Failed Image Test: " << stem << ".png differs from " << baseline << " by "
     << stem + ".diff.png\n";
  return FAILED;
}
