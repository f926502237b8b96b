// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TransferTable_h
#define tetralux_TransferTable_h

#include <vector>

namespace tetralux
{

/// Colour and opacity over scalar and gradient length (Knittel 1999, section 7), interpolated
/// bilinearly between its entries; outside of them it is as at its border.
///
/// For vtkVolumeProperty::SetTransferFunction2D of VTK 9.1, whose texture covers the range of the
/// volume's scalars, and gradients up to a quarter of that range over a mean spacing, with entries
/// at the centres of texels: column i of n lies at (i + 0.5) / n of the range.
struct TransferTable
{
  struct alignas(16) Entry
  {
    float Color[3]; ///< red, green, blue, not multiplied by anything; usually 0..1
    float Opacity;  ///< as the attenuation of ImageOptics::Function
  };

  int Columns = 0;            ///< over scalars
  int Rows = 0;               ///< over gradient lengths
  std::vector<Entry> Entries; ///< row after row
  double FirstScalar = 0;     ///< of the first column
  double LastScalar = 1;      ///< of the last column, above the first one's
  double FirstLength = 0;     ///< of the first row, as ImageOptics::GradientOpacity has lengths
  double LastLength = 1;      ///< of the last row, above the first one's
};

} // namespace tetralux

#endif
