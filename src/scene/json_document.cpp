#include "scene/json_document.h"

#include "base/error.h"
#include "scene/scene_format.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isoglass {

namespace {

using nlohmann::json;

/// Builds the document from the parser's events, watching for repeated keys.
class DocumentBuilder : public nlohmann::json_sax<json> {
  public:
    DocumentBuilder(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t&) override { return add(value); }
    bool string(string_t& value) override { return add(std::move(value)); }
    bool binary(binary_t& value) override { return add(std::move(value)); }
    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& value) override {
        json& object = *open_.back().value;
        if (object.contains(value)) {
            throw Error("the key " + inQuotes(value) + " appears twice",
                        jsonPlace(name_, childPointer(open_.back().pointer, value)), "keep one of the two");
        }
        key_ = value;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception& error) override {
        throw Error("not valid JSON: " + reason(error.what()), name_ + ", " + lineAndColumn(position));
    }

  private:
    struct Open {
        json* value;
        std::string pointer;
    };

    /// The library's message without its own prefix and position.
    static std::string reason(std::string message) {
        const std::size_t column = message.find("column ");
        std::size_t begin =
            message.find(column == std::string::npos ? "] " : ": ", column == std::string::npos ? 0 : column);
        begin = begin == std::string::npos ? 0 : begin + 2;
        return message.substr(begin);
    }

    std::string lineAndColumn(std::size_t position) const {
        const std::string_view before = text_.substr(0, position == 0 ? 0 : position - 1);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::size_t newline = before.rfind('\n');
        const std::size_t column =
            newline == std::string_view::npos ? before.size() : before.size() - newline - 1;
        return "line " + std::to_string(line) + ", column " + std::to_string(column + 1);
    }

    json* place(json value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        json& parent = *open_.back().value;
        if (parent.is_object()) return &(parent[key_] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }

    bool add(json value) {
        place(std::move(value));
        return true;
    }

    bool open(json container) {
        std::string pointer;
        if (!open_.empty()) {
            const Open& parent = open_.back();
            pointer = childPointer(parent.pointer,
                                   parent.value->is_object() ? key_ : std::to_string(parent.value->size()));
        }
        json* const value = place(std::move(container));
        open_.push_back({value, std::move(pointer)});
        return true;
    }

    bool close() {
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    const std::string& name_;
    json root_;
    std::vector<Open> open_;
    std::string key_;
};

}  // namespace

json parseJson(std::string_view text, const std::string& name) {
    DocumentBuilder builder(text, name);
    json::sax_parse(text, &builder);
    return builder.take();
}

std::string childPointer(const std::string& pointer, std::string_view token) {
    std::string child = pointer + "/";
    for (const char letter : token) {
        if (letter == '~') {
            child += "~0";
        } else if (letter == '/') {
            child += "~1";
        } else {
            child += letter;
        }
    }
    return child;
}

std::string jsonPlace(const std::string& name, const std::string& pointer) {
    return pointer.empty() ? name : name + ", " + pointer;
}

}  // namespace isoglass
