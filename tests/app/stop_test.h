#pragma once

#include "app/app_test.h"

#include <chrono>
#include <functional>
#include <thread>

namespace isoglass::test {

/// Runs that are stopped by signals.
class StopTest : public AppTest {
  protected:
    void SetUp() override {
        importOcean();
        writeScene();
    }

    /// Looks again and again until it is so, for a minute at most.
    static bool eventually(const std::function<bool()>& isSo) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (std::chrono::steady_clock::now() < end) {
            if (isSo()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return false;
    }

    bool anyFile(const std::function<bool(const std::string&)>& is) const {
        const auto names = files();
        return std::any_of(names.begin(), names.end(), is);
    }

    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    static bool isPart(const std::string& name) { return contains(name, ".part-"); }
};

}  // namespace isoglass::test
