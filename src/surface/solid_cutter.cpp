#include "surface/solid_cutter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace isoglass {

namespace {

bool usable(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v != glm::vec3(0);
}

}  // namespace

std::size_t PointTable::CutHash::operator()(const CutKey& key) const {
    // Odd multipliers of the golden ratio's digits spread ids that lie close together.
    std::uint64_t h = key.low * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29)) + key.high * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 31)) + static_cast<std::uint64_t>(key.plane) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(h ^ (h >> 32));
}

PointId PointTable::sample(glm::ivec3 lattice) const {
    const glm::ivec3 count = space_.cells + 1;
    return kFirstSample + (static_cast<PointId>(lattice.z) * count.y + lattice.y) * count.x + lattice.x;
}

glm::dvec3 PointTable::position(PointId point) const {
    if (isSample(point)) {
        const PointId linear = point - kFirstSample;
        const glm::ivec3 count = space_.cells + 1;
        const auto x = static_cast<std::size_t>(linear % count.x);
        const auto y = static_cast<std::size_t>(linear / count.x % count.y);
        const auto z = static_cast<std::size_t>(linear / count.x / count.y);
        return {space_.axes[0].coordinate[x], space_.axes[1].coordinate[y], space_.axes[2].coordinate[z]};
    }
    if (point < mesh_.positions.size()) return mesh_.positions[point];
    return cutPositions_[point - mesh_.positions.size()];
}

glm::vec3 PointTable::normal(PointId point) const {
    if (isSample(point)) return glm::vec3(0);
    if (point < mesh_.normals.size()) return mesh_.normals[point];
    return cutNormals_[point - mesh_.normals.size()];
}

PointId PointTable::cut(PointId a, PointId b, double distanceA, double distanceB, int plane) {
    if (a > b) {
        std::swap(a, b);
        std::swap(distanceA, distanceB);
    }
    const auto [found, isNew] = cuts_.try_emplace({a, b, plane}, vertexAndCutCount());
    if (isNew) {
        const double t = distanceA / (distanceA - distanceB);
        const glm::dvec3 from = position(a);
        cutPositions_.emplace_back(from + t * (position(b) - from));
        const glm::vec3 normalA = normal(a);
        const glm::vec3 between = normalA + static_cast<float>(t) * (normal(b) - normalA);
        cutNormals_.push_back(usable(between) ? between : normalA);
    }
    return found->second;
}

PlaneCutter::PlaneCutter(PointTable& points, const CutPlane& plane, glm::dvec3 meshOrigin, int number)
    : points_(points), plane_(glm::dvec3(plane.plane), plane.distance(meshOrigin)), number_(number) {}

double PlaneCutter::distance(PointId point) const {
    return distance(points_.position(point));
}

void PlaneCutter::cut(Polyhedron& polyhedron) {
    result_.clear();
    result_.alternates = polyhedron.alternates;
    segments_.clear();
    for (const Polyhedron::Polygon& polygon : polyhedron.polygons) cutPolygon(polyhedron, polygon);
    closeLoops();
    std::swap(polyhedron, result_);
}

void PlaneCutter::cutPolygon(const Polyhedron& from, const Polyhedron::Polygon& polygon) {
    const std::span<const PointId> points = from.pointsOf(polygon);
    const std::size_t count = points.size();
    distances_.resize(count);
    for (std::size_t i = 0; i < count; ++i) distances_[i] = distance(points[i]);
    const auto first = static_cast<std::uint32_t>(result_.points.size());
    const std::size_t firstSegment = segments_.size();
    // A run of cut-off points begins with a segment's start; the run that holds point 0 ends first.
    PointId entry = 0;
    bool entryWaits = false;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const bool keptHere = distances_[i] >= 0;
        const bool keptNext = distances_[next] >= 0;
        if (keptHere) result_.points.push_back(points[i]);
        if (keptHere == keptNext) continue;
        const PointId made = points_.cut(points[i], points[next], distances_[i], distances_[next], number_);
        result_.points.push_back(made);
        if (keptHere) {
            segments_.push_back({0, made, false});
        } else if (segments_.size() > firstSegment) {
            segments_.back().from = made;
        } else {
            entry = made;
            entryWaits = true;
        }
    }
    if (entryWaits) segments_.back().from = entry;
    if (segments_.size() - firstSegment > 1) result_.alternates = true;
    const auto kept = static_cast<std::uint32_t>(result_.points.size()) - first;
    if (kept > 0) result_.polygons.push_back({polygon.origin, first, kept});
}

/// Every point that the plane cut from an edge ends one segment and begins another: the edge's two polygons
/// run along it in opposite directions.
void PlaneCutter::closeLoops() {
    for (std::size_t begin = 0; begin < segments_.size(); ++begin) {
        if (segments_[begin].used) continue;
        const auto first = static_cast<std::uint32_t>(result_.points.size());
        std::size_t at = begin;
        do {
            segments_[at].used = true;
            result_.points.push_back(segments_[at].from);
            const PointId wanted = segments_[at].to;
            const auto next = std::find_if(segments_.begin(), segments_.end(),
                                           [wanted](const Segment& s) { return s.from == wanted; });
            at = static_cast<std::size_t>(next - segments_.begin());
            if (next == segments_.end() || (next->used && at != begin))
                throw std::logic_error("cut of a polyhedron that is not closed");
        } while (at != begin);
        const auto count = static_cast<std::uint32_t>(result_.points.size()) - first;
        result_.polygons.push_back({kFirstCapOrigin + number_, first, count});
    }
}

}  // namespace isoglass
