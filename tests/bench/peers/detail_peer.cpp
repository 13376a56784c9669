// A frame of a time series as a mesh, with IsoGlass and with VTK in one run: two key frames of the blobs are
// interpolated in time and the surface is extracted with normals. VTK gets its own threads for the
// interpolation, vtkFlyingEdges3D, and a heap that keeps its pages. IsoGlass makes full resolution, and the
// detail that a view of 720 pixels asks for.
// usage: detail_peer [ROUNDS]
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/detail_error.h"

#include <glm/trigonometric.hpp>
#include <malloc.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace isoglass {
namespace {

constexpr float kIso = 0.5f;
constexpr float kFraction = 0.3f;

double milliseconds(const std::function<void()>& run) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// The volume fills 720 pixels.
View view(double errorPixels) {
    View view;
    view.pixelsPerUnit = 720 / (2 * std::tan(glm::radians(15.0)));
    view.eye = glm::dvec3(1, 2, 0.5) * (2 * view.pixelsPerUnit / 720 / std::sqrt(5.25));
    view.errorPixels = errorPixels;
    return view;
}

class VtkSide {
  public:
    VtkSide(int size, std::vector<float> a, std::vector<float> b) : a_(std::move(a)), b_(std::move(b)) {
        image_->SetDimensions(size, size, size);
        image_->SetSpacing(2.0 / (size - 1), 2.0 / (size - 1), 2.0 / (size - 1));
        image_->SetOrigin(-1, -1, -1);
        values_->SetNumberOfTuples(static_cast<vtkIdType>(a_.size()));
        image_->GetPointData()->SetScalars(values_);
        filter_->SetInputData(image_);
        filter_->SetValue(0, kIso);
        filter_->ComputeNormalsOn();
        filter_->ComputeGradientsOff();
        filter_->ComputeScalarsOff();
    }

    std::size_t frame() {
        const std::size_t threads = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t share = (a_.size() + threads - 1) / threads;
        float* const out = values_->GetPointer(0);
        {
            std::vector<std::jthread> workers;
            for (std::size_t begin = 0; begin < a_.size(); begin += share) {
                workers.emplace_back([&, begin, out] {
                    const std::size_t end = std::min(begin + share, a_.size());
                    for (std::size_t i = begin; i < end; ++i) out[i] = a_[i] + kFraction * (b_[i] - a_[i]);
                });
            }
        }
        values_->Modified();
        image_->Modified();
        filter_->Update();
        return static_cast<std::size_t>(filter_->GetOutput()->GetNumberOfCells());
    }

  private:
    std::vector<float> a_, b_;
    vtkNew<vtkFloatArray> values_;
    vtkNew<vtkImageData> image_;
    vtkNew<vtkFlyingEdges3D> filter_;
};

std::vector<float> denseSamples(const KeyFrame& frame) {
    const glm::ivec3 dims = frame.dims();
    std::vector<float> samples;
    samples.reserve(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
    glm::ivec3 i;
    for (i.z = 0; i.z < dims.z; ++i.z)
        for (i.y = 0; i.y < dims.y; ++i.y)
            for (i.x = 0; i.x < dims.x; ++i.x) samples.push_back(frame.sample(i));
    return samples;
}

struct Way {
    std::string name;
    std::function<std::size_t()> frame;  ///< returns its triangles
    std::vector<double> times = {};
};

void compare(int size) {
    const Lattice lattice = makeUnitLattice(size);
    // All samples, so that nobody gains from the generator.
    constexpr float kNoFloor = std::numeric_limits<float>::min();
    const TimedField field{makeSparseBlobs(lattice, 0, kNoFloor), makeSparseBlobs(lattice, 0.1, kNoFloor),
                           kFraction};
    for (const auto& frame : {field.a, field.b}) frame->detailError();
    VtkSide vtk(size, denseSamples(*field.a), denseSamples(*field.b));
    const auto ours = [&](std::optional<View> from, bool still) {
        return extractSurface(lattice, field, {.iso = kIso, .view = std::move(from), .still = still})
            .mesh.triangleCount();
    };
    std::vector<Way> ways{{"vtk lerp + flying edges", [&] { return vtk.frame(); }},
                          {"isoglass full", [&] { return ours(std::nullopt, false); }},
                          {"isoglass 0.5 px", [&] { return ours(view(0.5), false); }},
                          {"isoglass 0.5 px, still", [&] { return ours(view(0.5), true); }}};
    for (int run = 0; run < 9; ++run) {
        for (Way& way : ways) way.times.push_back(milliseconds([&] { way.frame(); }));
    }
    const auto median = [](std::vector<double> times) {
        std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
        return times[times.size() / 2];
    };
    const double peer = median(ways[0].times);
    for (Way& way : ways) {
        std::printf(R"({"name":"%s","size":%d,"median_ms":%.2f,"triangles":%zu,"times_faster":%.1f})"
                    "\n",
                    way.name.c_str(), size, median(way.times), way.frame(), peer / median(way.times));
    }
    std::fflush(stdout);
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    // Memory that is freed stays with the process: mapping it anew costs VTK more than it costs IsoGlass.
    mallopt(M_MMAP_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 1;
    for (int round = 0; round < rounds; ++round) {
        for (const int size : {256, 512}) isoglass::compare(size);
    }
}
