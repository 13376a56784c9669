#pragma once

#include "base/error.h"
#include "volume/frame_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace isoglass::test {

/// Passes where `action` throws an Error whose text holds all `words`.
inline testing::AssertionResult failsWith(const std::function<void()>& action,
                                          std::initializer_list<std::string_view> words) {
    try {
        action();
    } catch (const Error& error) {
        const std::string text = error.what();
        for (const std::string_view word : words)
            if (text.find(word) == std::string::npos)
                return testing::AssertionFailure() << "\"" << text << "\" does not say \"" << word << "\"";
        return testing::AssertionSuccess() << text;
    }
    return testing::AssertionFailure() << "no Error was thrown";
}

/// Passes where one note holds `words`.
inline testing::AssertionResult hasNote(const SeriesDescription& description, std::string_view words) {
    auto result = testing::AssertionFailure() << "no note says \"" << words << "\":";
    for (const std::string& note : description.notes) {
        if (note.find(words) != std::string::npos) return testing::AssertionSuccess() << note;
        result << "\n" << note;
    }
    return result;
}

inline std::size_t sampleCount(const SeriesDescription& description) {
    std::size_t count = 1;
    for (const Axis& axis : description.lattice.axes) count *= axis.size();
    return count;
}

inline std::vector<float> readFrame(FrameSource& source, std::size_t frame) {
    // A value that no test file holds: what the source does not write is seen.
    std::vector<float> samples(sampleCount(source.description()), -12345.0f);
    source.read(frame, samples);
    return samples;
}

/// A path in the tests' own scratch folder; the name of the running test makes it unique.
inline std::filesystem::path scratchFile(const std::string& ending) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    return std::filesystem::path(testing::TempDir()) /
           (std::string("isoglass_") + test->test_suite_name() + "_" + test->name() + "_" + ending);
}

}  // namespace isoglass::test
