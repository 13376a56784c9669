#include "surface/clip_output.h"

#include <glm/geometric.hpp>

#include <limits>
#include <utility>

namespace isoglass {

namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

}  // namespace

ClipOutput::ClipOutput(const PointTable& points, const IndexSpace& space, const ExtractOptions& options)
    : points_(points), space_(space), options_(options) {}

void ClipOutput::keepTriangles(const SurfaceMesh& mesh, std::size_t first, std::size_t count) {
    const auto begin = mesh.triangles.begin() + static_cast<std::ptrdiff_t>(3 * first);
    triangles_.insert(triangles_.end(), begin, begin + static_cast<std::ptrdiff_t>(3 * count));
}

void ClipOutput::add(const Polyhedron& polyhedron, glm::ivec3 cell, bool whole) {
    for (const Polyhedron::Polygon& polygon : polyhedron.polygons) {
        const std::span<const PointId> points = polyhedron.pointsOf(polygon);
        if (polygon.origin == kOnSurface) {
            for (std::size_t i = 2; i < points.size(); ++i) addTriangle(points[0], points[i - 1], points[i]);
        } else if (isCap(polygon.origin, cell)) {
            const bool convex = whole || polygon.origin < kFirstCapOrigin;
            addCap(points, polygon.origin, convex && !polyhedron.alternates);
        }
    }
}

bool ClipOutput::isCap(PolygonOrigin origin, glm::ivec3 cell) const {
    if (origin >= kFirstCapOrigin)
        return options_.clip[static_cast<std::size_t>(origin - kFirstCapOrigin)].cap;
    const int axis = origin / 2;
    const int end = origin % 2 == 0 ? 0 : space_.cells[axis] - 1;
    return options_.closed && !space_.periodic[axis] && cell[axis] == end;
}

void ClipOutput::addTriangle(PointId a, PointId b, PointId c) {
    if (space_.mirrored) std::swap(b, c);
    triangles_.insert(triangles_.end(), {a, b, c});
}

/// A fan's inner chords join points of different faces of the cell, so no other cell has the same chord: that
/// holds for the convex section of a whole cell and for a face at the domain's end. Elsewhere a star around
/// the middle is safe.
void ClipOutput::addCap(std::span<const PointId> points, PolygonOrigin origin, bool fan) {
    const auto emit = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (space_.mirrored) std::swap(b, c);
        capTriangles_.insert(capTriangles_.end(), {a, b, c});
    };
    const std::size_t count = points.size();
    if (fan || count == 3) {
        const std::uint32_t apex = capVertex(points[0], origin);
        for (std::size_t i = 2; i < count; ++i)
            emit(apex, capVertex(points[i - 1], origin), capVertex(points[i], origin));
        return;
    }
    const std::uint32_t middle = middleVertex(points, origin);
    for (std::size_t i = 0; i < count; ++i)
        emit(middle, capVertex(points[i], origin), capVertex(points[(i + 1) % count], origin));
}

std::uint32_t ClipOutput::capVertex(PointId point, PolygonOrigin origin) {
    const auto next = static_cast<std::uint32_t>(capVertices_.size());
    const auto [found, isNew] = capIndex_.try_emplace({point, origin}, next);
    if (isNew) capVertices_.push_back({point, glm::vec3(points_.position(point)), origin});
    return found->second;
}

std::uint32_t ClipOutput::middleVertex(std::span<const PointId> points, PolygonOrigin origin) {
    glm::dvec3 sum(0);
    for (const PointId point : points) sum += points_.position(point);
    capVertices_.push_back({kNoPoint, glm::vec3(sum / static_cast<double>(points.size())), origin});
    return static_cast<std::uint32_t>(capVertices_.size() - 1);
}

/// Away from what is kept.
glm::vec3 ClipOutput::capNormal(PolygonOrigin origin) const {
    if (origin >= kFirstCapOrigin) {
        const CutPlane& plane = options_.clip[static_cast<std::size_t>(origin - kFirstCapOrigin)];
        return glm::vec3(-glm::normalize(glm::dvec3(plane.plane)));
    }
    const auto& coordinate = space_.axes[origin / 2].coordinate;
    const bool rising = coordinate.back() > coordinate.front();
    glm::vec3 normal(0);
    normal[origin / 2] = rising == (origin % 2 == 1) ? 1.0f : -1.0f;
    return normal;
}

void ClipOutput::finish(Extraction& extraction) const {
    std::vector<std::uint32_t> places(points_.vertexAndCutCount(), kUnused);
    for (const PointId point : triangles_) places[point] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t& place : places) {
        if (place != kUnused) place = count++;
    }
    extraction.mesh = {};
    extraction.mesh.origin = space_.origin;
    extraction.mesh.positions.resize(count);
    extraction.mesh.normals.resize(count);
    writeMesh(places, extraction.mesh);
    writeCaps(places, extraction);
}

void ClipOutput::writeMesh(const std::vector<std::uint32_t>& places, SurfaceMesh& mesh) const {
    for (PointId point = 0; point < places.size(); ++point) {
        if (places[point] == kUnused) continue;
        mesh.positions[places[point]] = glm::vec3(points_.position(point));
        mesh.normals[places[point]] = points_.normal(point);
    }
    mesh.triangles.reserve(triangles_.size());
    for (const PointId point : triangles_) mesh.triangles.push_back(places[point]);
}

void ClipOutput::writeCaps(const std::vector<std::uint32_t>& places, Extraction& extraction) const {
    auto next = static_cast<std::uint32_t>(extraction.mesh.positions.size());
    std::unordered_map<PointId, std::uint32_t> offSurface;
    extraction.caps = {};
    extraction.caps.origin = space_.origin;
    extraction.capIdentity.clear();
    for (const CapVertex& vertex : capVertices_) {
        extraction.caps.positions.push_back(vertex.position);
        extraction.caps.normals.push_back(capNormal(vertex.origin));
        if (vertex.point < places.size() && places[vertex.point] != kUnused) {
            extraction.capIdentity.push_back(places[vertex.point]);
        } else if (vertex.point == kNoPoint) {
            extraction.capIdentity.push_back(next++);
        } else {
            const auto [found, isNew] = offSurface.try_emplace(vertex.point, next);
            if (isNew) ++next;
            extraction.capIdentity.push_back(found->second);
        }
    }
    extraction.caps.triangles = capTriangles_;
}

SurfaceMesh joinCaps(const Extraction& extraction) {
    SurfaceMesh joined = extraction.mesh;
    const SurfaceMesh& caps = extraction.caps;
    for (std::size_t i = 0; i < caps.positions.size(); ++i) {
        if (extraction.capIdentity[i] < joined.positions.size()) continue;
        joined.positions.push_back(caps.positions[i]);
        joined.normals.push_back(caps.normals[i]);
    }
    for (const std::uint32_t index : caps.triangles)
        joined.triangles.push_back(extraction.capIdentity[index]);
    return joined;
}

}  // namespace isoglass
