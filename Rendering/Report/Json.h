// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_Json_h
#define tetralux_Json_h

#include <nlohmann/json.hpp>

namespace tetralux
{

/// What statistics are written as: members in the order in which they are set; a number that is not
/// finite becomes null.
using Json = nlohmann::ordered_json;

} // namespace tetralux

#endif
