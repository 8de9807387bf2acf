// SPDX-License-Identifier: BSD-3-Clause
// ComponentLibrary: searches the added components, then the dictionary's files.
#include "hinge/molecular/components.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "hinge/core/error.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

constexpr const char* debian_dictionary = "/usr/share/refmac/monomers";

/// True if the name can be used in a path: letters and digits only.
bool is_plain(const std::string& name) {
  return !name.empty() &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 && c < 128; });
}

/// Returns the dictionary's file of a monomer: a/ATP.cif, or c/CON_CON.cif for names that some file systems reserve.
std::filesystem::path file_of(const std::filesystem::path& dictionary, const std::string& name) {
  const char folder = static_cast<char>(std::tolower(static_cast<unsigned char>(name.front())));
  std::filesystem::path plain = dictionary / std::string(1, folder) / (name + ".cif");
  if (std::filesystem::is_regular_file(plain)) return plain;
  return dictionary / std::string(1, folder) / (name + "_" + name + ".cif");
}

}  // namespace

ComponentLibrary::ComponentLibrary(std::filesystem::path dictionary) : dictionary_(std::move(dictionary)) {
  if (!dictionary_.empty() && !std::filesystem::is_directory(dictionary_))
    throw LoadError(dictionary_.string() + ": is not a folder, expected the folder of a monomer dictionary");
}

void ComponentLibrary::add_file(const std::filesystem::path& path) {
  std::vector<Component> found = parse_components(read_bytes(path), path.string());
  if (found.empty()) throw LoadError(path.string() + ": has no chem_comp_bond, expected components with their bonds");
  for (Component& component : found) add(std::move(component));
}

void ComponentLibrary::add(Component component) {
  component.given = true;
  std::string name = component.name;
  components_.emplace(std::move(name), std::move(component));
}

const Component* ComponentLibrary::find(const std::string& name) {
  const auto known = components_.find(name);
  if (known != components_.end()) return known->second ? &*known->second : nullptr;
  std::optional<Component>& entry = components_[name];
  if (dictionary_.empty() || !is_plain(name)) return nullptr;
  const std::filesystem::path file = file_of(dictionary_, name);
  if (!std::filesystem::is_regular_file(file)) return nullptr;
  for (Component& component : parse_components(read_bytes(file), file.string()))
    if (component.name == name) {
      entry = std::move(component);
      entry->source = dictionary_.string();
    }
  return entry ? &*entry : nullptr;
}

std::filesystem::path installed_dictionary() {
  if (const char* named = std::getenv("CLIBD_MON"); named != nullptr && *named != '\0') return named;
  return std::filesystem::is_directory(debian_dictionary) ? debian_dictionary : "";
}

}  // namespace hinge::molecular
