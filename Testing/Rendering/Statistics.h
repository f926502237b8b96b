// SPDX-License-Identifier: BSD-3-Clause
#ifndef Statistics_h
#define Statistics_h

#include "Report/Json.h"

#include "vtkTetrahedraVolumeMapper.h"

#include <string>

/// The first member of this name, at any depth, that is no object itself; nullptr if there is none.
inline const tetralux::Json* FindStatistic(const tetralux::Json& object, const std::string& name)
{
  for (const auto& [key, value] : object.items())
  {
    if (value.is_object())
    {
      if (const tetralux::Json* found = FindStatistic(value, name))
      {
        return found;
      }
    }
    else if (key == name)
    {
      return &value;
    }
  }
  return nullptr;
}

/// A statistic of a mapper's last frame as JSON in one line. statistics: all of them.
inline std::string GetStatistic(const std::string& statistics, const std::string& name)
{
  const tetralux::Json all = tetralux::Json::parse(statistics);
  const tetralux::Json* found = FindStatistic(all, name);
  return found ? found->dump() : "no statistic " + name;
}

inline std::string GetStatistic(vtkTetrahedraVolumeMapper* mapper, const std::string& name)
{
  return GetStatistic(mapper->GetStatistics(), name);
}

#endif
