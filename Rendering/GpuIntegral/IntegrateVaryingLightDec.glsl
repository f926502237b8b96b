// SPDX-License-Identifier: BSD-3-Clause
// Emission and absorption of a segment under light that varies along it: RayCastVaryingLight.h,
// which this follows. Needs SegmentWeightsDec.glsl, TransferIntervalsDec.glsl and
// LightAlongRayDec.glsl.

// There is always an end, whatever a compiler makes of the arithmetic. With the shortest steps that
// FindLightSteps allows a direction turns around in some 800; from half of these on parts are as
// long as lets the others reach the end.
const int LargestNumberOfLightParts = 1024;
const float LongLightPart = 2.0 / 1024.0;

// Shares of a segment that are nearer than this are one: half the shortest part.
const float NearlyLightPart = 0.5 * ShortestPart;

// Opacity behind which single precision keeps nothing.
const float OpaqueLightPart = 1.0 - 1.0 / 16777216.0;

// Light factors that are parabolas, x = (share - Begin) InverseLength - 1/2 from -1/2 to 1/2.
struct LightPart
{
  float Begin, End, InverseLength;
  float Weight; // the largest in the picture for which it is right enough
  LightFactors Middle, Slope, Bend;
};

// shortest: no part is shorter.
LightPart MakeLightPart(
  LightPath path, float begin, float weight, float heavyEnd, float shortest)
{
  LightPart part;
  part.Begin = begin;
  part.Weight = weight >= SmallLightWeight ? 1.0 : max(weight, SmallLightWeight * LeastLightWeight);
  float end = min(1.0, max(FindLightEnd(path, begin, weight, heavyEnd), begin + shortest));
  float size = end - begin;
  part.End = end < 1.0 ? end : 2.0; // no share comes there
  part.InverseLength = 1.0 / size;
  part.Middle = FindLightAt(path, begin + 0.5 * size);
  LightFactors first = FindLightAt(path, begin + (0.5 - LightSampleReach) * size);
  LightFactors last = FindLightAt(path, begin + (0.5 + LightSampleReach) * size);
  float ofSlope = 0.5 / LightSampleReach;
  float ofBend = 0.5 / (LightSampleReach * LightSampleReach);
  part.Slope.Scale = ofSlope * (last.Scale - first.Scale);
  part.Slope.Add = ofSlope * (last.Add - first.Add);
  part.Bend.Scale =
    ofBend * ((first.Scale - part.Middle.Scale) + (last.Scale - part.Middle.Scale));
  part.Bend.Add = ofBend * ((first.Add - part.Middle.Add) + (last.Add - part.Middle.Add));
  return part;
}

vec3 ApplyLight(LightPart part, float share, vec3 color)
{
  float x = (share - part.Begin) * part.InverseLength - 0.5;
  return color * ((part.Bend.Scale * x + part.Slope.Scale) * x + part.Middle.Scale) +
    ((part.Bend.Add * x + part.Slope.Add) * x + part.Middle.Add);
}

vec4 IntegrateShadedSegment(float front, float back, float len, vec3 frontGradient,
  vec3 backGradient, vec3 frontPoint, vec3 backPoint, vec3 direction)
{
  LightPath path =
    MakeLightPath(frontGradient, backGradient, frontPoint, backPoint, direction);
  float inverseLength = 1.0 / len;
  LightPart light;
  light.End = -1.0;
  light.Weight = 0.0;
  vec4 gathered = vec4(0.0);
  SegmentWalk walk = StartWalk(front, back, len);
  do
  {
    float before = walk.Length;
    Piece piece = TakePiece(walk);
    float segmentBegin = 1.0 - before * inverseLength;
    float segmentLength = (before - walk.Length) * inverseLength;
    float slope = piece.BackDepth - piece.FrontDepth;
    float begin = 0.0;  // as a share of the piece
    float hidden = 0.0; // opacity of the piece up to there
    bool more = piece.FrontDepth + piece.BackDepth > 0.0;
    for (int part = 0; more && part < LargestNumberOfLightParts; ++part)
    {
      float share = segmentBegin + begin * segmentLength;
      float frontAttenuation = piece.FrontDepth + slope * begin;
      float twiceDepth = (frontAttenuation + piece.BackDepth) * (1.0 - begin);
      float weight = (1.0 - gathered.a) * min(1.0, 0.5 * twiceDepth);
      // Up to the end of the part of light, and no further than the weights of thin segments reach.
      float end = 1.0;
#ifndef ONLY_THIN_SEGMENTS
      float root =
        sqrt(max(0.0, frontAttenuation * frontAttenuation + 2.0 * ThinDepth * slope));
      bool thick = 2.0 * ThinDepth < twiceDepth;
      end = thick ? begin + 2.0 * ThinDepth / (frontAttenuation + root) : end;
#endif
      if (light.End <= share + NearlyLightPart || light.Weight < weight)
      {
        float shortest = part < LargestNumberOfLightParts / 2 ? 0.0 : LongLightPart;
        light = MakeLightPart(path, share, weight, segmentBegin + end * segmentLength, shortest);
      }
      float ofPart = segmentLength > 0.0 ? (light.End - segmentBegin) / segmentLength : 1.0;
      end = min(end, max(begin, ofPart));
      bool last = end >= 1.0;
      float frontDepth = frontAttenuation * (end - begin);
      float backDepth = (last ? piece.BackDepth : piece.FrontDepth + slope * end) * (end - begin);
      vec2 weights = WeighThinSegment(frontDepth, backDepth);
      float opacity = weights.x + weights.y;
      float ofBulge = FindBulgeShare(frontDepth, backDepth) * opacity;
      float middle = 0.5 * (begin + end);
      vec3 frontColor =
        ApplyLight(light, share, GetPieceColor(piece, begin));
      vec3 backColor = ApplyLight(light, segmentBegin + end * segmentLength,
        GetPieceColor(piece, end));
      vec3 middleColor = ApplyLight(light, segmentBegin + middle * segmentLength,
        GetPieceColor(piece, middle));
      vec3 bulge = middleColor - 0.5 * (frontColor + backColor);
      vec3 color = weights.x * frontColor + weights.y * backColor + ofBulge * bulge;
      gathered += (1.0 - gathered.a) * vec4(color, opacity);
      hidden += (1.0 - hidden) * opacity;
      begin = end;
      more = !last && hidden <= OpaqueLightPart;
    }
  } while (walk.More);
  return gathered;
}
