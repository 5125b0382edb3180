"""Recordings of ROS become tables that the program replays. There is no ROS in Debian 12 that writes rosbag2 or MCAP: the
files here are written by their specifications, in both orders of bytes, and a motion goes through them digit by digit."""

import math
import os
import sqlite3
import struct
import subprocess
import sys
import tempfile
import unittest

SCRIPT = "assets/ros/bag_to_csv.py"
PROGRAM = os.environ["CHAINREEL"]
T0 = 1_700_000_000_123_456_789  # ns since 1970


class Writer:
    """CDR: numbers aligned to their size, counted from behind the head."""

    def __init__(self, order):
        self.order, self.body = order, b""

    def number(self, code, size, value):
        self.body += b"\0" * (-len(self.body) % size) + struct.pack(self.order + code, value)
        return self

    def text(self, text):
        self.number("I", 4, len(text.encode()) + 1).body += text.encode() + b"\0"
        return self

    def list(self, write, values):
        self.number("I", 4, len(values))
        for value in values:
            write(value)
        return self

    def message(self):
        return (b"\0\1\0\0" if self.order == "<" else b"\0\0\0\0") + self.body


def joint_state(stamp, names, q, qd=(), tau=(), order="<", frame="base_link"):
    w = Writer(order)
    w.number("i", 4, stamp // 10**9).number("I", 4, stamp % 10**9).text(frame)
    w.list(w.text, names)
    for values in (q, qd, tau):
        w.list(lambda value: w.number("d", 8, value), values)
    return w.message()


def write_sqlite(path, messages, kind="sensor_msgs/msg/JointState"):
    base = sqlite3.connect(path)
    base.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
                 "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
    base.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
    topics = sorted({topic for topic, _, _ in messages})
    for i, topic in enumerate(topics):
        base.execute("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')", (i + 1, topic, kind))
    base.execute("INSERT INTO topics VALUES(99, '/other', 'std_msgs/msg/String', 'cdr', '')")
    base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(99, 1, x'00')")
    for topic, logged, data in messages:
        base.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", (topics.index(topic) + 1, logged, data))
    base.commit()
    base.close()


def record(code, content):
    return struct.pack("<BQ", code, len(content)) + content


def prefixed(data):
    return struct.pack("<I", len(data)) + data


def write_mcap(path, messages, compression=None, compress=lambda data: data):
    head = record(3, struct.pack("<H", 1) + prefixed(b"sensor_msgs/msg/JointState") + prefixed(b"ros2msg") + prefixed(b"text"))
    topics = sorted({topic for topic, _, _ in messages})
    for i, topic in enumerate(topics):
        head += record(4, struct.pack("<HH", i + 1, 1) + prefixed(topic.encode()) + prefixed(b"cdr") + prefixed(b""))
    body = b"".join(record(5, struct.pack("<HIQQ", topics.index(t) + 1, 0, logged, logged) + data) for t, logged, data in messages)
    content = head + body
    if compression is not None:
        packed = compress(content)
        content = record(6, struct.pack("<QQQI", 0, 1, len(content), 0) + prefixed(compression.encode()) + struct.pack("<Q", len(packed)) + packed)
    with open(path, "wb") as file:
        file.write(b"\x89MCAP0\r\n" + record(1, prefixed(b"ros2") + prefixed(b"test")) + content + record(15, b"\0\0\0\0") +
                   record(2, b"\0" * 20) + b"\x89MCAP0\r\n")


def swing(order="<", names=("joint2", "joint1")):
    """101 messages of a motion of the rr, its joints in the other order, with their rates."""
    messages = []
    for k in range(101):
        t = 0.01 * k
        q = {"joint1": 0.5 * math.sin(3 * t), "joint2": 1 - math.cos(2 * t)}
        qd = {"joint1": 1.5 * math.cos(3 * t), "joint2": 2 * math.sin(2 * t)}
        stamp = T0 + 10_000_000 * k
        data = joint_state(stamp, names, [q[n] for n in names], [qd[n] for n in names], order=order)
        messages.append(("/joint_states", stamp + 500, data))
    return messages


class BagToCsv(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, name):
        return os.path.join(self.folder.name, name)

    def convert(self, *words):
        return subprocess.run([sys.executable, SCRIPT, *words], capture_output=True, text=True)

    def table(self, *words):
        result = self.convert(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        head, *rows = result.stdout.splitlines()
        return head.split(","), [[float(cell) for cell in row.split(",")] for row in rows]

    def refused(self, *words):
        result = self.convert(*words)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertNotIn("Traceback", result.stderr)
        self.assertEqual(len(result.stderr.strip().splitlines()), 1, result.stderr)
        return result.stderr

    def expect_swing(self, head, rows):
        self.assertEqual(head, ["t [s]", "q.joint1 [rad]", "q.joint2 [rad]", "qd.joint1 [rad/s]", "qd.joint2 [rad/s]"])
        self.assertEqual(len(rows), 101)
        for k, row in enumerate(rows):
            t = 0.01 * k
            # Numbers keep all their digits; instants are exact in ns.
            self.assertEqual(row[1:], [0.5 * math.sin(3 * t), 1 - math.cos(2 * t), 1.5 * math.cos(3 * t), 2 * math.sin(2 * t)])
            self.assertEqual(row[0], float(f"{k * 10_000_000 / 1e9:.9f}"))

    def test_reads_rosbag2_in_both_orders_of_bytes(self):
        for order in "<>":
            path = self.file(f"bag{ord(order)}.db3")
            write_sqlite(path, swing(order))
            self.expect_swing(*self.table(path))

    def test_reads_a_folder_of_parts_and_puts_them_in_order(self):
        os.mkdir(self.file("bag"))
        write_sqlite(self.file("bag/bag_1.db3"), swing()[50:])
        write_sqlite(self.file("bag/bag_0.db3"), swing()[:55])  # some are in both
        self.expect_swing(*self.table(self.file("bag")))

    def test_reads_mcap_with_and_without_chunks(self):
        for name, compression in (("plain.mcap", None), ("chunk.mcap", "")):
            write_mcap(self.file(name), swing(), compression)
            self.expect_swing(*self.table(self.file(name)))

    def test_reads_what_a_broken_off_mcap_holds(self):
        write_mcap(self.file("whole.mcap"), swing())
        with open(self.file("whole.mcap"), "rb") as whole, open(self.file("part.mcap"), "wb") as part:
            part.write(whole.read()[:4000])
        result = self.convert(self.file("part.mcap"))
        self.assertEqual(result.returncode, 0)
        self.assertIn("ends within a record", result.stderr)
        self.assertLess(len(result.stdout.splitlines()), 102)

    def test_compressed_chunks_are_read_or_their_package_is_named(self):
        for kind, package, module in (("zstd", "python3-zstandard", "zstandard"), ("lz4", "python3-lz4", "lz4.frame")):
            path = self.file(kind + ".mcap")
            try:
                tool = __import__(module, fromlist=["frame"])
            except ImportError:
                write_mcap(path, swing(), kind)
                self.assertIn("apt install " + package, self.refused(path))
                continue
            write_mcap(path, swing(), kind, tool.ZstdCompressor().compress if kind == "zstd" else tool.compress)
            self.expect_swing(*self.table(path))

    def test_the_program_replays_what_comes_out(self):
        write_mcap(self.file("a.mcap"), swing())
        result = self.convert(self.file("a.mcap"), "-o", self.file("log.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.file("scene.yaml"), "w") as scene:
            scene.write(f"model: {os.path.abspath('models/rr.urdf')}\nmotion: log.csv\nvideo: {{fps: 100}}\n")
        run = subprocess.run([PROGRAM, "simulate", self.file("scene.yaml"), "--columns", "t,q,qd,qdd", "-o", "-"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "", "nothing is to be remarked")
        rows = [[float(cell) for cell in line.split(",")] for line in run.stdout.splitlines()[1:]]
        self.assertEqual(len(rows), 101)
        for k, row in enumerate(rows[2:-2]):
            t = 0.01 * (k + 2)
            self.assertEqual(row[1], 0.5 * math.sin(3 * t))
            # Of a spline through rates every 10 ms: h^4 of their fifth derivative, some 1e-8 x 100.
            self.assertAlmostEqual(row[5], -4.5 * math.sin(3 * t), delta=1e-5)

    def test_sliding_joints_and_chosen_ones(self):
        path = self.file("a.db3")
        write_sqlite(path, [("/js", T0 + k, joint_state(T0 + k, ["a", "b", "c"], [k, 1, 2], tau=[3, 4, 5])) for k in range(3)])
        head, rows = self.table(path, "--joints", "c,a", "--sliding", "c")
        self.assertEqual(head, ["t [s]", "q.c [m]", "q.a [rad]", "tau.c [N]", "tau.a [N m]"])
        self.assertEqual(rows[2], [2e-9, 2, 2, 5, 3])

    def test_what_makes_no_table_is_told_in_one_line(self):
        def bag(name, messages):
            write_sqlite(self.file(name), messages)
            return self.file(name)

        def message(k, *parts, topic="/js", **more):
            return (topic, T0 + k, joint_state(T0 + k, *parts, **more))

        two = [message(0, ["a"], [1]), message(1, ["a"], [2])]
        self.table(bag("good.db3", two))  # negative control
        self.assertIn("choose one with --topic", self.refused(bag("two.db3", two + [message(2, ["a"], [1], topic="/other")])))
        self.assertIn("no joint states on /x", self.refused(self.file("good.db3"), "--topic", "/x"))
        self.assertIn("a motion takes two or more", self.refused(bag("one.db3", two[:1])))
        self.assertIn("tells nothing of b", self.refused(bag("other.db3", two + [message(2, ["b"], [1])])))
        self.assertIn("has 2 numbers of 1 joints", self.refused(bag("count.db3", two + [message(2, ["a"], [1, 2])])))
        self.assertIn("no position", self.refused(bag("nan.db3", two + [message(2, ["a"], [math.nan])])))
        self.assertIn("say different things", self.refused(bag("stamp.db3", two + [message(1, ["a"], [7])])))
        self.assertIn("ends before", self.refused(bag("short.db3", two + [("/js", T0, joint_state(T0, ["a"], [1.0])[:40])])))
        zero = [("/js", T0 + k, joint_state(0, ["a"], [k])) for k in range(3)]
        self.assertIn("--stamp log", self.refused(bag("zero.db3", zero)))
        self.assertEqual(len(self.table(self.file("zero.db3"), "--stamp", "log")[1]), 3)
        self.assertIn("no message of the type", self.refused(bag("none.db3", [])))
        for name, text in (("a.db3", b"nonsense" * 100), ("a.mcap", b"nonsense"), ("a.txt", b""), ("b.mcap", b"\x89MCAP0\r\n" + b"\5" + struct.pack("<Q", 3) + b"abc")):
            with open(self.file(name), "wb") as file:
                file.write(text)
            self.refused(self.file(name))
        self.refused(self.file("is_not_there.db3"))


if __name__ == "__main__":
    unittest.main()
