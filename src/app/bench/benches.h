#pragma once

namespace isoglass {

/// Each registers its benchmarks with Google Benchmark: `name` of a benchmark is NAME/SIZE or
/// NAME/SIZE/THREADS; the counter `triangles` says how many the result has.
///@{

/// Interpolation in time and extraction of analytic fields at 64^3, 128^3 and 256^3 samples.
void registerExtraction(int threads, int repetitions);
/// Meshes of the blobs for one view, at 128^3 to 1024^3 samples, for both metrics of detail.
void registerDetail(int threads, int repetitions);
/// Whole frames and every pass of every method, three surfaces at 512^2 and 1024^2 pixels.
void registerPasses(int repetitions);
///@}

}  // namespace isoglass
