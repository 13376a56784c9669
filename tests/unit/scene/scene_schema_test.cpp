#include "scene/scene_format.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <map>
#include <set>
#include <string>

namespace isoglass {
namespace {

using nlohmann::json;

/// Keys of each object by its pointer, with `*` for the place in an array.
using Keys = std::map<std::string, std::set<std::string>>;

json schema() {
    return json::parse(std::ifstream(ISOGLASS_SCHEMA));
}

void collect(const json& root, const json& part, const std::string& pointer, Keys& keys) {
    if (const auto reference = part.find("$ref"); reference != part.end()) {
        collect(root, root.at(json::json_pointer(reference->get<std::string>().substr(1))), pointer, keys);
    }
    if (const auto choices = part.find("oneOf"); choices != part.end()) {
        for (const json& choice : *choices) collect(root, choice, pointer, keys);
    }
    if (const auto items = part.find("items"); items != part.end())
        collect(root, *items, pointer + "/*", keys);
    if (const auto properties = part.find("properties"); properties != part.end()) {
        EXPECT_EQ(part.value("additionalProperties", json()), json(false)) << pointer;
        for (const auto& [key, value] : properties->items()) {
            keys[pointer].insert(key);
            collect(root, value, pointer + "/" + key, keys);
        }
    }
}

TEST(SceneSchema, HasTheKeysThatAreReadAndNoOthers) {
    Keys inSchema;
    collect(schema(), schema(), "", inSchema);
    Keys inParser;
    for (const FormatObject& object : sceneFormat()) {
        inParser[std::string(object.pointer)] = {object.keys.begin(), object.keys.end()};
    }
    EXPECT_EQ(inSchema, inParser);
}

void expectDescriptions(const json& part, const std::string& pointer) {
    if (!part.is_object()) return;
    if (const auto properties = part.find("properties");
        properties != part.end() && properties->is_object()) {
        for (const auto& [key, value] : properties->items()) {
            EXPECT_TRUE(value.contains("description") || value.contains("$ref"))
                << pointer << "/properties/" << key;
        }
    }
    for (const auto& [key, value] : part.items()) expectDescriptions(value, pointer + "/" + key);
}

TEST(SceneSchema, DescribesEveryKey) {
    expectDescriptions(schema(), "");
}

}  // namespace
}  // namespace isoglass
