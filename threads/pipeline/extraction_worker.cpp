#include "pipeline/extraction_worker.h"

namespace isoglass {

ExtractionWorker::ExtractionWorker(Extract extract, Mailbox<FrameMeshes>& results)
    : extract_(std::move(extract)), results_(results), thread_([this](std::stop_token stop) { run(stop); }) {}

void ExtractionWorker::run(std::stop_token stop) {
    while (std::optional<FrameRequest> request = requests_.take(stop)) {
        FrameMeshes result;
        result.request = *request;
        try {
            result.meshes = extract_(*request);
        } catch (...) {
            result.failure = std::current_exception();
        }
        results_.post(std::move(result));
    }
}

}  // namespace isoglass
