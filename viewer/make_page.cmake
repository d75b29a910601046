# Puts style and script into page.html and the whole into a C++ file; run by CMakeLists.txt.
cmake_minimum_required(VERSION 3.24)
file(READ ${SOURCE_DIR}/page.html page)
file(READ ${SOURCE_DIR}/style.css style)
file(READ ${SCRIPT} script)
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")

# Compilers need not accept literals above 65,536 characters.
set(pieces "")
string(LENGTH "${page}" size)
set(begin 0)
while(begin LESS size)
  string(SUBSTRING "${page}" ${begin} 16000 piece)
  string(APPEND pieces "    R\"__page__(${piece})__page__\",\n")
  math(EXPR begin "${begin} + 16000")
endwhile()
file(WRITE ${OUTPUT} "#include \"octupole/view/internal/page_template.h\"

namespace octupole::internal {
namespace {

const std::string_view kPieces[] = {
${pieces}};

}  // namespace

extern const std::string_view* const kPageTemplate = kPieces;
extern const std::size_t kPageTemplateSize = sizeof(kPieces) / sizeof(kPieces[0]);

}  // namespace octupole::internal
")
