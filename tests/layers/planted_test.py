"""scripts/check_layers finds each kind of violation where it is planted, and nothing in a clean tree."""
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.realpath(sys.argv.pop(1))

CLEAN = {
    "lib/base/error.cpp": '#include "base/error.h"\n#include <fmt/format.h>\n#include <string>\n',
    "lib/base/CMakeLists.txt": "gainsmith_room(base SOURCES error.cpp PUBLIC fmt::fmt)\n",
    "lib/verify/check.cpp": '#include "verify/check.h"\n#include <Eigen/Core>\n#include "hybrid/arc.h"\n',
    "lib/verify/CMakeLists.txt": "gainsmith_room(verify\n  SOURCES check.cpp\n  ROOMS base expr model hybrid)\n",
    "apps/gainsmith/main.cpp": '#include <CLI/CLI.hpp>\n#include "gainsmith/load.h"\n#include "io/json/json_text.h"\n',
}


def check(files):
    """The exit code and the lines of check_layers on a tree of these files."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([sys.executable, SCRIPT, "--root", root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout.splitlines()


class Planted(unittest.TestCase):
    def assert_found(self, path, text, place, words):
        code, lines = check({**CLEAN, path: text})
        self.assertEqual(code, 1)
        self.assertEqual(len(lines), 1, lines)
        self.assertTrue(lines[0].startswith(place + ": "), lines[0])
        self.assertIn(words, lines[0])

    def test_clean_tree(self):
        self.assertEqual(check(CLEAN), (0, []))

    def test_rooms_say_what_they_hold(self):
        table = "| room | contents |\n|---|---|\n"
        rooms = {path: "# of " + path.split("/")[1] + "\n" + text for path, text in CLEAN.items() if path.endswith(".txt")}
        guide = {"CONTRIBUTING.md": "The rooms:\n\n" + table + "| base | of base |\n| verify | of verify |\n\nRules\n"}
        self.assertEqual(check({**CLEAN, **rooms, **guide}), (0, []))
        rooms["lib/verify/CMakeLists.txt"] = rooms["lib/verify/CMakeLists.txt"].replace("of verify", "of runs")
        self.assertIn("the table of rooms", check({**CLEAN, **rooms, **guide})[1][0])
        self.assertIn("lib/base/CMakeLists.txt:1", check({**CLEAN, **guide})[1][0])

    def test_room_below_the_wall(self):
        self.assert_found("lib/verify/a.cpp", '\n#include "design/synthesize.h"\n', "lib/verify/a.cpp:2",
                          "verify may not include design")

    def test_what_poses_does_not_judge(self):
        self.assert_found("lib/lmi/a.cpp", '#include "verdict/refutation.h"\n', "lib/lmi/a.cpp:1",
                          "lmi may not include verdict")

    def test_runs_are_judged_without_the_verdict(self):
        self.assert_found("lib/verify/a.cpp", '#include "verdict/margins.h"\n', "lib/verify/a.cpp:1",
                          "verify may not include verdict")

    def test_algorithms_know_no_program(self):
        self.assert_found("lib/numerics/a.h", '#include "expr/program/program.h"\n', "lib/numerics/a.h:1",
                          "numerics may not include expr")

    def test_binding_stays_behind_its_room(self):
        self.assert_found("lib/verify/a.cpp", '#include "bind/binding.h"\n', "lib/verify/a.cpp:1",
                          "verify works on what is bound")
        self.assertEqual(check({**CLEAN, "lib/verify/a.cpp": '#include "bind/stated.h"\n'}), (0, []))

    def test_room_above(self):
        self.assert_found("lib/expr/a.h", '#pragma once\n#include "model/method.h"\n', "lib/expr/a.h:2",
                          "expr may not include model")

    def test_app_is_no_room_for_libraries(self):
        self.assert_found("lib/io/a.h", '#include "gainsmith/load.h"\n', "lib/io/a.h:1", "io may not include apps")

    def test_third_party_in_another_room(self):
        self.assert_found("apps/gainsmith/a.cpp", "#include <nlohmann/json.hpp>\n", "apps/gainsmith/a.cpp:1",
                          "nlohmann-json")

    def test_unknown_third_party(self):
        self.assert_found("lib/model/a.h", "#  include <spdlog/spdlog.h>\n", "lib/model/a.h:1", "no third party")

    def test_include_without_room(self):
        self.assert_found("lib/model/a.cpp", '#include "../sdp/solver.h"\n', "lib/model/a.cpp:1", "room/solver.h")

    def test_folder_that_is_no_room(self):
        self.assert_found("lib/misc/a.cpp", "int a;\n", "lib/misc/a.cpp:1", "no room")

    def test_linked_room(self):
        self.assert_found("lib/verify/CMakeLists.txt",
                          "gainsmith_room(verify\n  SOURCES check.cpp\n  ROOMS base model\n        sdp)\n",
                          "lib/verify/CMakeLists.txt:4", "verify may not link sdp")

    def test_linked_third_party(self):
        self.assert_found("lib/model/CMakeLists.txt", "gainsmith_room(model SOURCES a.cpp PRIVATE yaml-cpp)\n",
                          "lib/model/CMakeLists.txt:1", "yaml-cpp")

    def test_linked_beside_the_function(self):
        self.assert_found("lib/model/CMakeLists.txt", "target_link_libraries(gainsmith_model\n  PUBLIC gainsmith_lmi)\n",
                          "lib/model/CMakeLists.txt:2", "model may not link lmi")

    def test_machine_path(self):
        path = "/" + "root" + "/data.yaml"
        self.assert_found("docs/a.md", "one\nsee " + path + " here\n", "docs/a.md:2", path)

    def test_tree_without_sources_is_an_error(self):
        self.assertEqual(check({"README.md": "nothing\n"})[0], 2)


if __name__ == "__main__":
    unittest.main()
