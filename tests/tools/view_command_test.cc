#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command_line.h"

// What the pages show, viewer/tests/ looks at in a browser.

namespace octupole {
namespace {

using testing::HasSubstr;

const std::string kCommand = OCTUPOLE_COMMAND;

nlohmann::json ScenesOf(const std::filesystem::path& path) {
  const std::string page = ReadText(path), start = "id=\"scenes\">";
  const std::size_t begin = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(ViewCommand, MakesThePageThatFieldMakes) {
  const TemporaryFolder folder;
  const Outcome solved = Shell("cd " + Quoted(folder.path()) + " && " + kCommand + " field " + Bracket() +
                               " -o a.vtu --singularities c.vtu --html a.html");
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_THAT(solved.out, HasSubstr("written    a.html"));
  const Outcome viewed = Shell("cd " + Quoted(folder.path()) + " && " + kCommand +
                               " view a.vtu --singularities c.vtu --with a.vtu -o b.html");
  ASSERT_EQ(viewed.exit_code, 0) << viewed.err;
  EXPECT_THAT(viewed.out, HasSubstr("b.html; open it in a browser"));

  const nlohmann::json field = ScenesOf(folder / "a.html")[0], view = ScenesOf(folder / "b.html");
  ASSERT_EQ(view.size(), 2u);
  EXPECT_EQ(field["title"], "bracket.mesh");
  EXPECT_EQ(view[0]["title"], "a.vtu");
  EXPECT_GT(field["curves"].size(), 0u);
  for (const char* part : {"surfaces", "curves"}) EXPECT_EQ(view[0][part], field[part]) << part;  // from the file
  for (const char* part : {"surfaces", "curves", "markers"}) {
    EXPECT_EQ(view[1][part], field[part]) << part;  // traced anew
  }
  EXPECT_EQ(view[0]["figures"][0], nlohmann::json({"vertices", "5291"}));
}

TEST(ViewCommand, RefusesWhatIsNoField) {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& arguments) {
    return Shell("cd " + Quoted(folder.path()) + " && " + kCommand + " " + arguments);
  };
  const Outcome no_field = run("view " + Bracket() + " -o a.html");
  EXPECT_EQ(no_field.exit_code, 1);
  EXPECT_THAT(no_field.err, HasSubstr("bracket.mesh: this is no VTU file"));
  const Outcome no_folder = run("view a.vtu -o there/a.html");
  EXPECT_EQ(no_folder.exit_code, 1);
  EXPECT_THAT(no_folder.err, HasSubstr("there is no folder"));
  EXPECT_TRUE(ContentsOf(folder.path()).empty());
}

}  // namespace
}  // namespace octupole
