"""The Debian packages of this build: their fields, and a clean Debian in which they are installed, used and removed.

    package_test.py TREE BUILD [Program | Development]
"""
import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

from installed import BUILD, TREE, has, run, skip

for needed in ("dpkg-deb", "dpkg-shlibdeps", "cpack"):
    if not has(needed):
        skip(f"{needed} is not installed")

SUITE = "bookworm"


def fields(package):
    text = run("dpkg-deb", "--field", package).stdout
    return dict(re.findall(r"^([\w-]+): (.*(?:\n .*)*)", text, re.M))


def in_clean_debian(package, files, commands):
    """Runs commands in a Debian of essential packages with these files of the tree in /srv, after the package and before its removal; none:
    why it cannot."""
    if not has("mmdebstrap"):
        return "mmdebstrap is not installed: scripts/packages --with install"
    if os.getuid() != 0:
        return "this needs root"
    hooks = [f"--customize-hook=copy-in {package} {' '.join(os.path.join(TREE, file) for file in files)} /srv",
             f"--customize-hook=chroot \"$1\" apt-get install --yes --no-install-recommends /srv/{os.path.basename(package)}"]
    hooks += [f"--customize-hook=chroot \"$1\" sh -e -c '{command}'" for command in commands]
    hooks += [f"--customize-hook=chroot \"$1\" apt-get purge --yes {os.path.basename(package).split('_')[0]}",
              "--customize-hook=! find \"$1/usr\" \"$1/etc\" -name \"*gainsmith*\" | grep ."]
    done = subprocess.run(["mmdebstrap", "--variant=apt", "--format=null", "--include=python3-minimal,libpython3-stdlib",
                           "--dpkgopt=force-unsafe-io", "--dpkgopt=path-include=/usr/share/*",
                           "--aptopt=Acquire::Languages \"none\"", *hooks, SUITE, os.devnull],
                          capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)
    if done.returncode != 0 and "customize" not in done.stderr:
        return "no Debian could be made: " + done.stderr[-300:]
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
    return None


class OfPackages:
    @classmethod
    def setUpClass(cls):
        if not OfPackages.packages:  # made once: cpack looks at each file by a process
            run("cpack", "-G", "DEB", "-B", OfPackages.folder.name, "--config", os.path.join(BUILD, "CPackConfig.cmake"))
            OfPackages.packages = {os.path.basename(path).split("_")[0]: path for path in glob.glob(OfPackages.folder.name + "/*.deb")}
        with open(os.path.join(TREE, "CMakeLists.txt"), encoding="utf-8") as file:
            cls.version = re.search(r"VERSION (\S+)", file.read().partition("project(")[2]).group(1)

    folder = tempfile.TemporaryDirectory()
    packages = {}

    def try_in_clean_debian(self, package, files, commands):
        reason = in_clean_debian(self.packages[package], files, commands)
        if reason:
            print(f"skipped: {reason}", file=sys.stderr)
            self.skipTest(reason)


class Program(OfPackages, unittest.TestCase):
    def test_their_fields_are_right(self):
        self.assertEqual(sorted(self.packages), ["gainsmith", "gainsmith-dev"])
        for name, package in self.packages.items():
            found = fields(package)
            self.assertEqual(found["Package"], name)
            self.assertEqual(found["Version"], self.version)
            self.assertRegex(found["Description"], r"^\S.*\n \S")
            self.assertNotIn("\n  ", found["Description"])
            self.assertEqual(found["Architecture"], run("dpkg", "--print-architecture").stdout.strip())
            self.assertIn(f"usr/share/doc/{name}/copyright", run("dpkg-deb", "--contents", package).stdout)
        program = fields(self.packages["gainsmith"])
        self.assertRegex(program["Depends"], r"\blibc6 \(>= [\d.]+\)")
        self.assertRegex(program["Recommends"], r"libnlopt0.*ipopt")
        self.assertIn("libyaml-cpp-dev", fields(self.packages["gainsmith-dev"])["Depends"])

    def test_a_clean_debian_installs_runs_and_removes_it(self):
        share = "/usr/share/gainsmith"
        commands = ["gainsmith --version", f"test -s /usr/share/man/man1/gainsmith.1.gz && test -s {share}/LICENSE",
                    f"cd /srv && gainsmith run {share}/problems/ferrante-seuret-2021/t2-0.70.yaml -o /srv/results",
                    f"python3 -c \"import gainsmith; print(gainsmith.synth(\\\"{share}/problems/designs/lqr.yaml\\\"))\"",
                    # As it is where root used the module; the package removes it again.
                    "python3 -m compileall -q /usr/lib/python3/dist-packages/gainsmith",
                    f"GAINSMITH_TEST_PAGES=README.md python3 /srv/pages_test.py {share} /usr/bin/gainsmith Commands"]
        self.try_in_clean_debian("gainsmith", ["tests/docs/pages_test.py"], commands)


class Development(OfPackages, unittest.TestCase):
    def test_a_clean_debian_builds_the_example_of_the_library(self):
        commands = ["cd /srv/api && cmake -B build && cmake --build build",
                    "cd /srv && sed -n \"/^problem: motor/,/^\\`\\`\\`/p\" README.md | grep -v \"^\\`\\`\\`\" > motor.yaml",
                    "cd /srv && api/build/observer motor.yaml | grep \"holds: yes\""]
        self.try_in_clean_debian("gainsmith-dev", ["docs/api", "README.md"], commands)


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if result.wasSuccessful() and result.skipped:
        skip("; ".join(reason for _, reason in result.skipped))
    sys.exit(not result.wasSuccessful())
