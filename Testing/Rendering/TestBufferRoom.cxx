// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/BufferRoom.h"

#include "gtest/gtest.h"

namespace
{

TEST(BufferRoom, Obstacles)
{
  tetralux::TexelLimits limits;
  limits.MaximumTexels = 65536;
  EXPECT_EQ(tetralux::FindObstacle({ { "faces", 65536, 8 }, { "points", 10, 16 } }, limits), "");
  const std::string many = tetralux::FindObstacle({ { "faces", 65537, 8 } }, limits);
  EXPECT_NE(many.find("faces"), std::string::npos);
  EXPECT_NE(many.find("65537"), std::string::npos);
  EXPECT_NE(many.find("65536"), std::string::npos);

  limits.FreeBytes = 1000000;
  EXPECT_EQ(tetralux::FindObstacle({ { "faces", 65536, 8 } }, limits), "");
  const std::string full =
    tetralux::FindObstacle({ { "faces", 65536, 8 }, { "points", 40000, 16 } }, limits);
  EXPECT_NE(full.find("1164288"), std::string::npos);
  EXPECT_NE(full.find("1000000"), std::string::npos);
}

} // namespace
