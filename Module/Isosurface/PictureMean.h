// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PictureMean_h
#define tetralux_PictureMean_h

#include "Base/Cached.h"
#include "Base/Span.h"

#include <algorithm>
#include <vector>

namespace tetralux
{

/// The mean of pictures that differ in their samples alone.
class PictureMean
{
public:
  /// Starts anew unless the key is that of the pictures before.
  void Start(CacheKey key)
  {
    if (!this->Stamp.Has(key))
    {
      this->Stamp.Set(std::move(key));
      this->Count = 0;
      this->Colors.clear();
    }
  }

  /// Pictures that the mean is of.
  int GetCount() const { return this->Count; }

  /// Adds a picture, and replaces it by the mean.
  void Add(Span<float> colors)
  {
    this->Colors.resize(colors.size());
    ++this->Count;
    const float share = 1.f / static_cast<float>(this->Count);
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      this->Colors[i] += (colors[i] - this->Colors[i]) * share;
      colors[i] = this->Colors[i];
    }
  }

  /// Of the pictures that were added: one at least.
  void CopyTo(Span<float> colors) const
  {
    std::copy(this->Colors.begin(), this->Colors.end(), colors.begin());
  }

  void Reset() { *this = PictureMean(); }

private:
  CacheStamp Stamp;
  int Count = 0;
  std::vector<float> Colors;
};

} // namespace tetralux

#endif
