# cmake -DROOT=FOLDER -DOUT=FILE.cpp -P embed_shaders.cmake
# Writes every GLSL file below ROOT into OUT as a raw string, in the order of their names.
file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/*.vert" "${ROOT}/*.frag" "${ROOT}/*.glsl")
list(SORT files)
set(rows "")
foreach(name IN LISTS files)
  file(READ "${ROOT}/${name}" text)
  string(APPEND rows "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUT}" "#include \"gl/shader_source.h\"

namespace isoglass::gl {
namespace {

const ShaderFile kFiles[] = {
${rows}};

}  // namespace

std::span<const ShaderFile> embeddedShaders() { return kFiles; }

}  // namespace isoglass::gl
")
