#include "numeric/hard_cases.h"
#include "numeric/table_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

// The kernel has no run-time dispatch; a build for another processor is what could change its bytes. Each
// program holds the room `surface` compiled for one instruction set.

namespace isoglass::numeric {
namespace {

std::string outputOf(const std::string& set) {
    const std::string program = std::string(ISOGLASS_MESH_BYTES) + set;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(program.c_str(), "r"), pclose);
    std::string text;
    std::array<char, 4096> buffer;
    while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) text += buffer.data();
    return text;
}

bool runsHere(const std::string& set) {
    __builtin_cpu_init();
    if (set == "avx") return __builtin_cpu_supports("avx");
    if (set == "avx2_fma" || set == "haswell")
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
               __builtin_cpu_supports("bmi2");
    if (set == "avx512") return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
    return true;
}

class InstructionSets : public testing::TestWithParam<std::string> {};

TEST_P(InstructionSets, GiveTheBytesOfTheBaseline) {
    if (!runsHere(GetParam())) GTEST_SKIP() << "this processor has no " << GetParam();
    const std::string baseline = outputOf("baseline");
    EXPECT_EQ(std::ranges::count(baseline, '\n'), static_cast<std::ptrdiff_t>(hardCases().size()));
    EXPECT_EQ(outputOf(GetParam()), baseline);
    addTableRow("InstructionSet_" + GetParam(), "fused or wider arithmetic rounds differently",
                "same bytes in all " + std::to_string(hardCases().size()) + " cases");
}

INSTANTIATE_TEST_SUITE_P(Numeric, InstructionSets,
                         testing::Values("unoptimised", "avx", "avx2_fma", "haswell", "avx512"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace isoglass::numeric
