#include "scene/iso_date.h"

#include <algorithm>
#include <cstddef>

namespace isoglass {

namespace {

constexpr std::string_view kForm = "0000-00-00T00:00:00";

bool hasForm(std::string_view text) {
    const auto fits = [](char letter, char form) {
        return form == '0' ? letter >= '0' && letter <= '9' : letter == form;
    };
    return std::equal(text.begin(), text.end(), kForm.begin(), kForm.begin() + text.size(), fits);
}

bool fieldIsIn(std::string_view text, std::size_t offset, int least, int most) {
    if (offset >= text.size()) return true;
    const int value = (text[offset] - '0') * 10 + (text[offset + 1] - '0');
    return value >= least && value <= most;
}

}  // namespace

bool isIsoDate(std::string_view text) {
    constexpr std::size_t kDay = 10, kMinute = 16, kSecond = 19;
    if (text.size() != kDay && text.size() != kMinute && text.size() != kSecond) return false;
    return hasForm(text) && fieldIsIn(text, 5, 1, 12) && fieldIsIn(text, 8, 1, 31) &&
           fieldIsIn(text, 11, 0, 23) && fieldIsIn(text, 14, 0, 59) && fieldIsIn(text, 17, 0, 59);
}

}  // namespace isoglass
