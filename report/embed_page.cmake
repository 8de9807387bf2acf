# SPDX-License-Identifier: BSD-3-Clause
# Writes a page as C++: hinge::tool::PAGE_page() returns it in pieces, because compilers need not take long literals.
# Arguments: PAGE, HTML (file of ASCII characters), OUT.
file(READ ${HTML} text)
string(LENGTH "${text}" length)
file(WRITE ${OUT} "// Generated from ${HTML}\n#include <span>\n#include <string_view>\n\nnamespace hinge::tool {\n\n"
                  "std::span<const std::string_view> ${PAGE}_page();\n\n"
                  "std::span<const std::string_view> ${PAGE}_page() {\n"
                  "// Not constexpr: sanitizers of clang would need more steps than it takes.\n"
                  "static const std::string_view pieces[] = {\n")
set(step 60000)
set(begin 0)
while(begin LESS length)
  string(SUBSTRING "${text}" ${begin} ${step} piece)
  file(APPEND ${OUT} "R\"hinge_page(${piece})hinge_page\",\n")
  math(EXPR begin "${begin} + ${step}")
endwhile()
file(APPEND ${OUT} "};\nreturn pieces;\n}\n\n}  // namespace hinge::tool\n")
