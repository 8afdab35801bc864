# Writes OUTPUT, a C++ source with the table of the files TEXTS: name and content.
set(entries "")
foreach(path IN LISTS TEXTS)
  get_filename_component(name "${path}" NAME_WE)
  file(READ "${path}" content)
  string(APPEND entries "    {\"${name}\", R\"yaml(${content})yaml\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"methods/methods.h\"

namespace gainsmith::methods {

namespace {
constexpr Text kTexts[] = {
${entries}};
}  // namespace

std::span<const Text> all() { return kTexts; }

}  // namespace gainsmith::methods
")
