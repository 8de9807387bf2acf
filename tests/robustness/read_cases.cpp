// SPDX-License-Identifier: BSD-3-Clause
// Reads cases from JSON.
#include "robustness/read_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::robustness {
namespace {

using Json = nlohmann::json;

const Json& field(const Json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (found == object.end()) throw LoadError("field '" + std::string(key) + "' is missing");
  return *found;
}

double number(const Json& json, const char* key) {
  const std::string text = json.is_string() ? json.get<std::string>() : json.dump();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  // A number that overflows must not become an infinity.
  const bool overflows = std::isinf(value) && text.find_first_of("iI") == std::string::npos;
  if (!json.is_string() || text.empty() || *end != '\0' || overflows)
    throw LoadError("field '" + std::string(key) + "': " + text + ", expected a string holding a double");
  return value;
}

std::int64_t whole(const Json& json, const char* key) {
  if (!json.is_number_integer())
    throw LoadError("field '" + std::string(key) + "': " + json.dump() + ", expected a whole number");
  return json.get<std::int64_t>();
}

bool yes(const Json& object, const char* key) {
  const Json& json = field(object, key);
  if (!json.is_boolean())
    throw LoadError("field '" + std::string(key) + "': " + json.dump() + ", expected true or false");
  return json.get<bool>();
}

std::string text(const Json& object, const char* key) {
  const Json& json = field(object, key);
  if (!json.is_string()) throw LoadError("field '" + std::string(key) + "': " + json.dump() + ", expected a string");
  return json.get<std::string>();
}

template <class T, class Item>
std::vector<T> list(const Json& object, const char* key, const Item& item) {
  const Json& json = field(object, key);
  if (!json.is_array()) throw LoadError("field '" + std::string(key) + "': expected a list");
  std::vector<T> values;
  for (const Json& entry : json) values.push_back(static_cast<T>(item(entry, key)));
  return values;
}

std::vector<double> numbers(const Json& object, const char* key) { return list<double>(object, key, number); }
std::vector<std::int64_t> indices(const Json& object, const char* key) {
  return list<std::int64_t>(object, key, whole);
}

/// Returns the indices of all pairs in one list.
std::vector<std::int64_t> flat_pairs(const Json& object, const char* key) {
  std::vector<std::int64_t> ends;
  for (const auto& pair : list<std::vector<std::int64_t>>(object, key, [](const Json&entry, const char*name) {
         if (!entry.is_array() || entry.size() != 2)
           throw LoadError("field '" + std::string(name) + "': " + entry.dump() + ", expected two indices");
         return std::vector<std::int64_t>{whole(entry[0], name), whole(entry[1], name)};
       }))
    ends.insert(ends.end(), pair.begin(), pair.end());
  return ends;
}

/// Reads an index of an answer; a negative index is an error in the file.
std::size_t position(const Json& json, const char* key) {
  const std::int64_t value = whole(json, key);
  if (value < 0) throw LoadError("field '" + std::string(key) + "': " + json.dump() + ", expected an index");
  return static_cast<std::size_t>(value);
}

std::optional<Bracket> bracket(const Json& object, const std::string& key) {
  if (field(object, key.c_str()).is_null()) return {};
  const double value = number(field(object, key.c_str()), key.c_str());
  const auto side = [&](const char* suffix) {
    const std::string name = key + suffix;
    return object.contains(name) ? number(object[name], name.c_str()) : value;
  };
  return Bracket{side("_lo"), side("_hi")};
}

bool stable(const Json& object) { return !object.contains("stable") || yes(object, "stable"); }

void read_triangles(const Json& json, Case& one) {
  one.input = TrianglePair{numbers(json, "a"), numbers(json, "b")};
  if (!json.contains("intersect")) return;
  one.truth.emplace();
  one.truth->hit = yes(json, "intersect");
  one.truth->distance = bracket(json, "dist");
}

/// Sets `truth` if the line has an answer. Returns true if the answer is more than a refusal.
bool expects_answer(const Json& json, const char* verdict, Case& one) {
  const std::string expect = json.contains("expect") ? text(json, "expect") : json.contains(verdict) ? "answer" : "";
  if (expect.empty()) return false;
  if (expect != "answer" && expect != "refuse")
    throw LoadError("field 'expect': \"" + expect + "\", expected \"answer\" or \"refuse\"");
  if (expect == "answer" && !json.contains(verdict)) return false;
  one.truth.emplace();
  one.truth->refuse = expect == "refuse";
  return !one.truth->refuse;
}

void read_atoms(const Json& json, Case& one) {
  one.input = Atoms{
      whole(field(json, "n"), "n"),           numbers(json, "x"), indices(json, "type"),       indices(json, "group"),
      whole(field(json, "ntypes"), "ntypes"), numbers(json, "M"), flat_pairs(json, "excluded")};
  if (!expects_answer(json, "collides", one)) return;
  one.truth->hit = yes(json, "collides");
  one.truth->pair_count = position(field(json, "pair_count"), "pair_count");
  one.truth->pairs = list<std::uint32_t>(json, "pairs", position);
  one.truth->distance = bracket(json, "min_dist");
}

void read_meshes(const Json& json, Case& one) {
  one.input = MeshPair{{numbers(json, "va"), indices(json, "fa")},
                       {numbers(json, "vb"), indices(json, "fb")},
                       numbers(json, "ta"),
                       numbers(json, "tb")};
  if (!expects_answer(json, "intersect", one)) return;
  one.truth->hit = yes(json, "intersect");
  one.truth->stable = stable(json);
  one.truth->pair_count = position(field(json, "hit_pairs"), "hit_pairs");
  one.truth->distance = bracket(json, "dist");
}

void read_chain(const Json& json, Case& one) {
  const Json& links = field(json, "links");
  if (!links.is_array()) throw LoadError("field 'links': expected a list");
  Chain chain;
  for (const Json& link : links)
    chain.links.push_back({whole(field(link, "parent"), "parent"), numbers(link, "origin"), numbers(link, "axis"),
                           number(field(link, "angle"), "angle"), Mesh{numbers(link, "v"), indices(link, "f")}});
  one.input = std::move(chain);
  if (!expects_answer(json, "self_collides", one)) return;
  Truth& truth = *one.truth;
  truth.hit = yes(json, "self_collides");
  truth.stable = stable(json);
  for (const Json& pair : field(json, "pairs")) {
    const auto distance = bracket(pair, "dist");
    if (!distance) throw LoadError("field 'dist' of a pair: null, expected a string holding a double");
    truth.link_pairs.push_back({position(field(pair, "i"), "i"), position(field(pair, "j"), "j"),
                                yes(pair, "intersect"), stable(pair), *distance});
  }
  if (const Json& closest = field(json, "closest"); !closest.is_null()) {
    const auto ends = list<std::size_t>(json, "closest", position);
    if (ends.size() != 2) throw LoadError("field 'closest': " + closest.dump() + ", expected two links");
    truth.closest = {ends[0], ends[1]};
  }
  if (!json.contains("tip") || json["tip"].is_null()) return;
  const auto tip = numbers(json, "tip");
  if (tip.size() != 3) throw LoadError("field 'tip': expected three numbers");
  truth.tip = Vec3(tip[0], tip[1], tip[2]);
}

Case read_case(const std::string& line) {
  const Json json = Json::parse(line);
  if (!json.is_object()) throw LoadError("expected a JSON object");
  Case one;
  one.id = text(json, "id");
  one.kind = text(json, "kind");
  if (json.contains("family")) one.family = text(json, "family");
  if (one.kind == "tri_tri" || one.kind == "tri_tri_f32")
    read_triangles(json, one);
  else if (one.kind == "atoms")
    read_atoms(json, one);
  else if (one.kind == "mesh_pair")
    read_meshes(json, one);
  else if (one.kind == "chain")
    read_chain(json, one);
  else
    throw LoadError("unknown kind '" + one.kind + "', expected tri_tri, tri_tri_f32, atoms, mesh_pair or chain");
  return one;
}

/// Returns the parser's message without its own prefix "[json.exception.parse_error.101] ".
std::string plain(const std::string& message) {
  const std::size_t end = message.starts_with('[') ? message.find("] ") : std::string::npos;
  return end == std::string::npos ? message : message.substr(end + 2);
}

}  // namespace

std::vector<Case> read_cases(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".jsonl") files.push_back(at->path());
  if (error) throw LoadError(folder.string() + ": cannot be read as a folder: " + error.message());
  if (files.empty()) throw LoadError(folder.string() + ": holds no .jsonl file");
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for (const fs::path& file : files) {
    std::ifstream stream(file);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      try {
        cases.push_back(read_case(line));
      } catch (const std::exception& bad) {  // from the parser, or a LoadError
        throw LoadError(file.string() + ":" + std::to_string(number) + ": " + plain(bad.what()));
      }
    }
    // A folder can be opened as a file, but not read.
    if (!stream.eof()) throw LoadError(file.string() + ":" + std::to_string(number + 1) + ": cannot be read");
  }
  return cases;
}

}  // namespace hinge::robustness
