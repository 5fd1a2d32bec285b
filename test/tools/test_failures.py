#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the PCL-NURBS authors
"""Outputs that cannot be written and runs that are interrupted: nothing is left behind."""
import os
import resource
import signal
import subprocess
import time
import unittest

from interruption import wait_until_caught
from tool import ToolTest, pcd, ply, wave

FORMATS = ("nurbs", "json", "obj", "ply", "png")


def outputs_of_every_kind(name):
    """Arguments that write one file each."""
    for kind in FORMATS:
        yield f"{name}.{kind}", (f"{name}.{kind}",)
    yield f"{name}.pcd", ("--labels", f"{name}.pcd")
    yield f"{name}.report", ("x.json", "--report", f"{name}.report")


class CannotWrite(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("in.pcd", pcd(wave(), 80))

    def test_full_disk(self):
        for name, arguments in outputs_of_every_kind("full"):
            with self.subTest(name):
                os.symlink("/dev/full", self.folder / name)
                self.write("x.json", "as before")
                self.fail_with(4, "in.pcd", *arguments, says=[name, "No space left"])

    def test_limit_of_file_sizes(self):
        """The disk fills up in the middle of a file; an old one stays as it was."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (48, 48))
        for name, arguments in outputs_of_every_kind("large"):
            for old in (None, "old content"):
                with self.subTest(name, old=old):
                    if name.endswith("report"): # the other output must not fail first
                        os.symlink("/dev/null", self.folder / "null.pcd")
                        arguments = ("--labels", "null.pcd", "--report", name)
                    if old:
                        self.write(name, old)
                    self.fail_with(4, "in.pcd", *arguments, says=[name], preexec_fn=limit)
                    if old:
                        self.assertEqual((self.folder / name).read_text(), old)
                    for extra in ("null.pcd", name):
                        (self.folder / extra).unlink(missing_ok=True)

    def test_no_folder(self):
        for name, arguments in outputs_of_every_kind("no/folder"):
            with self.subTest(name):
                self.fail_with(4, "in.pcd", *arguments, says=[name])
        for name, arguments in outputs_of_every_kind("in.pcd/file"):
            with self.subTest(name):
                self.fail_with(4, "in.pcd", *arguments, says=[name])

    def test_a_folder_of_that_name(self):
        for name, arguments in outputs_of_every_kind("folder"):
            with self.subTest(name):
                (self.folder / name).mkdir()
                self.write("x.json", "as before")
                self.fail_with(4, "in.pcd", *arguments, says=[name])

    def test_name_too_long(self):
        for name, arguments in outputs_of_every_kind("n" * 300):
            with self.subTest(name):
                self.write("x.json", "as before")
                self.fail_with(4, "in.pcd", *arguments, says=[name])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_folder_without_permission(self):
        (self.folder / "locked").mkdir(mode=0o555)
        for name, arguments in outputs_of_every_kind("locked/file"):
            with self.subTest(name):
                self.fail_with(4, "in.pcd", *arguments, says=[name])

    @unittest.skipIf(os.geteuid() != 0, "only root sees a read-only system folder as one")
    def test_folder_that_takes_no_files(self):
        for name, arguments in outputs_of_every_kind("/proc/file"):
            with self.subTest(name):
                self.write("x.json", "as before")
                self.fail_with(4, "in.pcd", *arguments, says=[name])

    def test_devices_are_no_error(self):
        os.symlink("/dev/null", self.folder / "null.nurbs")
        self.succeed("in.pcd", "null.nurbs", "--report", "r.json")
        self.assertTrue((self.folder / "null.nurbs").is_symlink())


class Interrupted(ToolTest):
    """The large cloud takes seconds, so signals at these times meet every stage."""

    def interrupt(self, number, after, *arguments):
        with subprocess.Popen([self.binary, *arguments], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            wait_until_caught(process.pid, number)
            time.sleep(after)
            process.send_signal(number)
            out, error = process.communicate()
        return process.returncode, out, error

    def test_signals_leave_nothing_half_written(self):
        self.write("in.ply", ply(wave(640, 480)))
        names = [f"out.{kind}" for kind in FORMATS]
        interrupted = 0
        for number in (signal.SIGINT, signal.SIGTERM):
            for after in (0.3, 0.6, 1.0, 1.5, 2.0, 3.0):
                with self.subTest(number, after=after):
                    code, out, error = self.interrupt(number, after, "in.ply", *names)
                    left = set(self.names()) - {"in.ply"}
                    self.assertLessEqual(left, set(names), "no temporary file")
                    if code == 0:
                        self.assertEqual(left, set(names))
                    else:
                        interrupted += 1
                        self.assertEqual((code, out), (130, ""))
                        self.assertEqual(error, "pcd_to_nurbs: interrupted\n")
                        self.assertLess(left, set(names))
                    for name in left:
                        self.assertGreater((self.folder / name).stat().st_size, 50)
                        (self.folder / name).unlink()
        self.assertGreater(interrupted, 1)


if __name__ == "__main__":
    unittest.main()
