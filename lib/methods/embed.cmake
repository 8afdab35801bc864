# Writes OUTPUT, a C++ source with the table of the methods TEXTS: name, content, and the content of the problem below
# PROBLEMS that the method names as its example.
set(entries "")
foreach(path IN LISTS TEXTS)
  get_filename_component(name "${path}" NAME_WE)
  file(READ "${path}" content)
  set(example "")
  if(content MATCHES "\nexample: ([a-z0-9./-]+)\n")
    file(READ "${PROBLEMS}/${CMAKE_MATCH_1}.yaml" example)
  endif()
  string(APPEND entries "    {\"${name}\", R\"yaml(${content})yaml\", R\"yaml(${example})yaml\"},\n")
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
