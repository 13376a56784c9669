#include "base/error.h"

namespace isoglass {

namespace {

std::string sentence(const std::string& what, const std::string& where, const std::string& hint) {
    std::string text = what;
    if (!where.empty()) text += " (" + where + ")";
    if (!hint.empty()) text += "; " + hint;
    return text;
}

}  // namespace

Error::Error(const std::string& what, const std::string& where, const std::string& hint)
    : std::runtime_error(sentence(what, where, hint)), problem_(what), where_(where), hint_(hint) {}

}  // namespace isoglass
