#!/usr/bin/env python3
"""A table for chainreel of the joint states in a ROS recording.

    bag_to_csv.py RECORDING [-o log.csv] [--topic /joint_states] [--stamp header|log] [--joints a,b,..]

writes t [s], and of each joint q.NAME [rad], qd.NAME [rad/s], tau.NAME [N m], as far as all messages have them; sliding
joints, which a message does not tell from turning ones, are named by --sliding, and are in m, m/s and N. In a scene:

    motion: log.csv

RECORDING is
  - a folder or .db3 file of rosbag2 with its storage sqlite3,
  - an .mcap file (rosbag2's other storage, also by itself) whose messages are in CDR; chunks compressed with zstd or lz4 take
    Debian's python3-zstandard or python3-lz4,
  - a .bag of ROS 1, read by Debian's python3-rosbag.

Nothing of ROS is needed but for the last. Read are messages of the type sensor_msgs/JointState. Those of one instant and
those that come out of order are put in order by their stamps; of several of one stamp that say the same one is kept, and of
others none: that is an error. t is since the first message, exactly, in nanoseconds. Several publishers on one topic may each
tell some of the joints: choose them by --joints, of which each message must tell all or none.
"""

import argparse
import math
import os
import sqlite3
import struct
import sys

JOINT_STATE = ("sensor_msgs/msg/JointState", "sensor_msgs/JointState")


class Unreadable(Exception):
    """What is told the user in one line."""


# --- CDR, as DDS writes messages: OMG's "The Common Data Representation" in DDSI-RTPS 2.3, chapter 10. Numbers are aligned to
# their size, counted from behind the four bytes of the head; strings end in a zero that counts.
class Cdr:
    def __init__(self, data):
        if len(data) < 4 or data[0] != 0 or data[1] not in (0, 1):
            raise Unreadable("a message is not in plain CDR, which is all that is read")
        self.data = data
        self.order = "<" if data[1] == 1 else ">"
        self.at = 4

    def number(self, code, size):
        self.at += -(self.at - 4) % size
        if self.at + size > len(self.data):
            raise Unreadable("a message ends before its numbers do")
        value = struct.unpack_from(self.order + code, self.data, self.at)[0]
        self.at += size
        return value

    def count(self):
        count = self.number("I", 4)
        if count > len(self.data):
            raise Unreadable("a message ends before its numbers do")
        return count

    def text(self):
        length = self.count()
        piece = self.data[self.at : self.at + length]
        if len(piece) < length:
            raise Unreadable("a message ends within a name")
        self.at += length
        return bytes(piece[:-1]).decode("utf-8") if length else ""

    def numbers(self):
        return [self.number("d", 8) for _ in range(self.count())]


def joint_state(data):
    """(stamp in ns, names, positions, velocities, efforts) of a serialised JointState."""
    cdr = Cdr(data)
    seconds, nanoseconds = cdr.number("i", 4), cdr.number("I", 4)
    cdr.text()  # the frame
    names = [cdr.text() for _ in range(cdr.count())]
    return seconds * 10**9 + nanoseconds, names, cdr.numbers(), cdr.numbers(), cdr.numbers()


# --- the recordings: each gives (topic, type, time of the log in ns, a function that reads the message)
def of_sqlite(path):
    try:
        # Read only: a recording that is still being written is left alone.
        base = sqlite3.connect("file:" + path.replace("?", "%3f").replace("#", "%23") + "?mode=ro", uri=True)
        topics = {i: (n, t, s) for i, n, t, s in base.execute("SELECT id, name, type, serialization_format FROM topics")}
        for topic, stamp, data in base.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY id"):
            name, kind, form = topics[topic]
            if kind in JOINT_STATE and form != "cdr":
                raise Unreadable(f"{name} is serialised as {form}: only cdr is read")
            yield name, kind, stamp, lambda data=data: joint_state(data)
    except (sqlite3.Error, KeyError) as error:
        raise Unreadable(f"{path} is no rosbag2 in sqlite3: {error}") from error


# The specification of MCAP (mcap.dev/spec): records of an opcode, a length of eight bytes and a content, little-endian.
MAGIC = b"\x89MCAP0\r\n"
SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 3, 4, 5, 6, 15


def decompressed(kind, data, size):
    try:
        if kind == "":
            return data
        if kind == "zstd":
            import zstandard

            return zstandard.ZstdDecompressor().decompress(data, max_output_size=size)
        if kind == "lz4":
            import lz4.frame

            return lz4.frame.decompress(data)
    except ImportError as error:
        package = "python3-zstandard" if kind == "zstd" else "python3-lz4"
        raise Unreadable(f"the recording is compressed with {kind}: apt install {package}") from error
    raise Unreadable(f"the recording is compressed with {kind}, which is not known")


def records(data):
    at = 0
    while at + 9 <= len(data):
        code, length = data[at], struct.unpack_from("<Q", data, at + 1)[0]
        at += 9
        if at + length > len(data):
            print("note: the recording ends within a record: what stands before is read", file=sys.stderr)
            return
        yield code, data[at : at + length]
        at += length


def prefixed(data, at):
    length = struct.unpack_from("<I", data, at)[0]
    return bytes(data[at + 4 : at + 4 + length]), at + 4 + length


def of_mcap(path):
    with open(path, "rb") as file:
        data = file.read()
    if not data.startswith(MAGIC):
        raise Unreadable(f"{path} is no MCAP file")
    schemas, channels = {0: ""}, {}

    def walk(content):
        for code, record in records(content):
            if code == SCHEMA:
                schemas[struct.unpack_from("<H", record)[0]] = prefixed(record, 2)[0].decode()
            elif code == CHANNEL:
                channel, schema = struct.unpack_from("<HH", record)
                topic, at = prefixed(record, 4)
                form, _ = prefixed(record, at)
                channels[channel] = (topic.decode(), schemas.get(schema, ""), form.decode())
            elif code == MESSAGE:
                channel, _, stamp = struct.unpack_from("<HIQ", record)
                if channel not in channels:
                    raise Unreadable("a message is of a channel that is not told of")
                topic, kind, form = channels[channel]
                if kind in JOINT_STATE and form != "cdr":
                    raise Unreadable(f"{topic} is encoded as {form}: only cdr is read")
                yield topic, kind, stamp, lambda body=record[22:]: joint_state(body)
            elif code == CHUNK:
                size = struct.unpack_from("<Q", record, 16)[0]
                kind, at = prefixed(record, 28)
                length = struct.unpack_from("<Q", record, at)[0]
                yield from walk(memoryview(decompressed(kind.decode(), bytes(record[at + 8 : at + 8 + length]), size)))
            elif code == DATA_END:
                return

    try:
        yield from walk(memoryview(data)[len(MAGIC) :])
    except (struct.error, UnicodeDecodeError, ValueError) as error:
        raise Unreadable(f"{path} is spoilt: {error}") from error


def of_ros1(path):
    try:
        import rosbag
    except ImportError as error:
        raise Unreadable("a .bag of ROS 1 is read by python3-rosbag: apt install python3-rosbag python3-sensor-msgs") from error
    with rosbag.Bag(path) as bag:
        for topic, message, time in bag.read_messages():
            kind = getattr(message, "_type", "")
            yield topic, kind, time.to_nsec(), lambda m=message: (
                m.header.stamp.to_nsec(),
                list(m.name),
                list(m.position),
                list(m.velocity),
                list(m.effort),
            )


def messages_of(path):
    if os.path.isdir(path):
        parts = sorted(os.path.join(path, name) for name in os.listdir(path) if name.endswith((".db3", ".mcap")))
        if not parts:
            raise Unreadable(f"{path} holds neither .db3 nor .mcap")
        for part in parts:
            yield from messages_of(part)
    elif path.endswith(".db3"):
        yield from of_sqlite(path)
    elif path.endswith(".mcap"):
        yield from of_mcap(path)
    elif path.endswith(".bag"):
        yield from of_ros1(path)
    else:
        raise Unreadable(f"{path} is no .db3, .mcap or .bag, nor a folder of them (compressed files are to be unpacked before)")


# --- the table
def choose_topic(states, wanted):
    topics = sorted(states)
    if wanted:
        if wanted not in states:
            raise Unreadable(f"no joint states on {wanted}; there are {', '.join(topics) or 'none at all'}")
        return wanted
    if not topics:
        raise Unreadable("holds no message of the type sensor_msgs/JointState")
    if len(topics) > 1:
        raise Unreadable(f"joint states are on {', '.join(topics)}: choose one with --topic")
    return topics[0]


def row_of(message, joints, stamp):
    """q, qd, tau of the joints (None where the message has none), or None where it tells none of them."""
    _, names, *quantities = message
    present = [joint for joint in joints if joint in names]
    if not present:
        return None
    if len(present) < len(joints):
        missing = sorted(set(joints) - set(present))
        raise Unreadable(
            f"the message at {stamp} ns tells nothing of {', '.join(missing)}: several publishers? choose joints with --joints"
        )
    if len(set(names)) < len(names):
        raise Unreadable(f"the message at {stamp} ns tells of a joint twice")
    row = []
    for values in quantities:
        if values and len(values) != len(names):
            raise Unreadable(f"the message at {stamp} ns has {len(values)} numbers of {len(names)} joints")
        row.append([values[names.index(joint)] for joint in joints] if values else None)
    return row


def table_of(messages, joints):
    """(rows by stamp in ns, which of q, qd and tau all rows have)"""
    rows = {}
    for stamp, message in messages:
        row = row_of(message, joints, stamp)
        if row is None:
            continue
        if stamp in rows and rows[stamp] != row:
            raise Unreadable(
                f"two messages of the stamp {stamp} ns say different things: is it not set? take --stamp log, the time of the recording"
            )
        rows[stamp] = row
    if len(rows) < 2:
        raise Unreadable(f"holds {len(rows)} instants of these joints: a motion takes two or more")
    there = [all(row[i] is not None and all(map(math.isfinite, row[i])) for row in rows.values()) for i in range(3)]
    if not there[0]:
        raise Unreadable("some messages have no position, or one that is no number")
    return rows, there


def write(rows, there, joints, sliding, file):
    units = [("q", "rad", "m"), ("qd", "rad/s", "m/s"), ("tau", "N m", "N")]
    head = ["t [s]"]
    for (name, turning, straight), is_there in zip(units, there):
        if is_there:
            head += [f"{name}.{joint} [{straight if joint in sliding else turning}]" for joint in joints]
    print(",".join(head), file=file)
    first = min(rows)
    for stamp in sorted(rows):
        since = stamp - first
        cells = [f"{since // 10**9}.{since % 10**9:09d}"]
        for values, is_there in zip(rows[stamp], there):
            if is_there:
                cells += [repr(float(value)) for value in values]
        print(",".join(cells), file=file)


def convert(options):
    states = {}
    for topic, kind, logged, read in messages_of(options.recording):
        if kind not in JOINT_STATE or (options.topic and topic != options.topic):
            if kind in JOINT_STATE:
                states.setdefault(topic, [])
            continue
        message = read()
        states.setdefault(topic, []).append((logged if options.stamp == "log" else message[0], message))
    topic = choose_topic(states, options.topic)
    messages = states[topic]
    if not messages:
        raise Unreadable(f"no joint states on {topic}")
    if options.stamp == "header" and all(stamp == 0 for stamp, _ in messages):
        raise Unreadable("the stamps in the messages are not set: take --stamp log, the time of the recording")
    joints = options.joints.split(",") if options.joints else sorted({n for _, m in messages for n in m[1]})
    sliding = set(options.sliding.split(",")) if options.sliding else set()
    if unknown := sorted(sliding - set(joints)):
        raise Unreadable(f"--sliding names {', '.join(unknown)}; joints are {', '.join(joints)}")
    if bad := [joint for joint in joints if "," in joint or "\n" in joint]:
        raise Unreadable(f"a name no table can hold: {bad[0]!r}")
    rows, there = table_of(messages, joints)
    return rows, there, joints, sliding


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording")
    parser.add_argument("-o", "--output", default="-", help="a .csv; - is standard output")
    parser.add_argument("--topic", help="where several have joint states")
    parser.add_argument("--stamp", choices=["header", "log"], default="header", help="whose time: the message's, or the recording's")
    parser.add_argument("--joints", help="a,b,..: these alone, in this order; else all by their names")
    parser.add_argument("--sliding", help="a,b,..: joints that are in m, not rad")
    options = parser.parse_args()
    try:
        table = convert(options)
        if options.output == "-":
            write(*table, sys.stdout)
        else:
            # An existing table is replaced when the new one is whole.
            with open(options.output + ".part", "w", encoding="utf-8") as file:
                write(*table, file)
            os.replace(options.output + ".part", options.output)
            print(f"{options.output}: {len(table[0])} rows of {', '.join(table[2])}", file=sys.stderr)
    except (Unreadable, OSError) as error:
        sys.exit(f"{options.recording}: {error}")


if __name__ == "__main__":
    main()
