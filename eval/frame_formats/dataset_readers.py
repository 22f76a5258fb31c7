"""Readers of PNG and MCAP files and of ROS 2 messages, from the formats' own documents: https://mcap.dev/spec, ROS 2's
message definitions and CDR. They share no code with the writers. zstd is the library that dpkg needs, too.
"""

import ctypes
import struct
import zlib

WIDTH, HEIGHT = 640, 480  # of all images


def read_png(path):
    """Pixels as integers (gray) or as bytes of R, G, B."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    place, packed, header = 8, b"", None
    while place < len(data):
        length, kind = struct.unpack_from(">I4s", data, place)
        content = data[place + 8:place + 8 + length]
        assert zlib.crc32(kind + content) == struct.unpack_from(">I", data, place + 8 + length)[0], path
        header = struct.unpack(">IIBBBBB", content) if kind == b"IHDR" else header
        packed += content if kind == b"IDAT" else b""
        place += 12 + length
    width, height, bits, color, _, _, interlaced = header
    assert (width, height, interlaced) == (WIDTH, HEIGHT, 0), path
    pixel = {0: 1, 2: 3}[color] * bits // 8
    rows, raw, above = [], zlib.decompress(packed), bytes(width * pixel)
    for v in range(height):
        begin = v * (width * pixel + 1)
        above = unfiltered(raw[begin], raw[begin + 1:begin + 1 + width * pixel], above, pixel)
        rows.append(above)
    joined = b"".join(rows)
    return joined if color == 2 or bits == 8 else struct.unpack(f">{width * height}H", joined)


def unfiltered(kind, row, above, pixel):
    if kind == 0:
        return row
    out = bytearray(row)
    for i in range(len(out)):
        a, b, c = (out[i - pixel] if i >= pixel else 0), above[i], (above[i - pixel] if i >= pixel else 0)
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        out[i] = (out[i] + (a, b, (a + b) // 2, paeth)[kind - 1]) & 255
    return bytes(out)


class Fields:
    """The fields of a record of MCAP."""

    def __init__(self, data):
        self.data, self.place = data, 0

    def take(self, form):
        (value,) = struct.unpack_from("<" + form, self.data, self.place)
        self.place += struct.calcsize("<" + form)
        return value

    def raw(self, length):
        self.place += length
        assert self.place <= len(self.data)
        return self.data[self.place - length:self.place]

    def text(self):
        return self.raw(self.take("I")).decode()

    def pairs(self, first, second):
        inner = Fields(self.raw(self.take("I")))
        pairs = []
        while inner.place < len(inner.data):
            pairs.append(tuple(inner.text() if form == "s" else inner.take(form) for form in (first, second)))
        return pairs


def records_of(data, place, end):
    """Offset, operation and fields of each record."""
    while place < end:
        operation, length = struct.unpack_from("<BQ", data, place)
        yield place, operation, Fields(data[place + 9:place + 9 + length])
        place += 9 + length
    assert place == end


def decompressed(data, size):
    zstd = ctypes.CDLL("libzstd.so.1")
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    zstd.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    out = ctypes.create_string_buffer(size)
    assert zstd.ZSTD_decompress(out, size, data, len(data)) == size
    return out.raw


class Mcap:
    """Reads all messages in order and checks each index, count and CRC."""

    def __init__(self, path):
        self.data = data = path.read_bytes()
        assert data[:8] == data[-8:] == b"\x89MCAP0\r\n"
        footer = Fields(data[-28:-8])
        summary, offsets, crc = footer.take("Q"), footer.take("Q"), footer.take("I")
        assert data[-37] == 2 and offsets == 0 and crc == zlib.crc32(data[summary:-12])
        self.schemas, self.channels, self.messages, self.chunks, self.metadata = {}, {}, [], {}, {}
        self.read_data(summary)
        self.read_summary(summary)

    def read_data(self, end):
        records = list(records_of(self.data, 8, end))
        assert (records[0][1], records[-1][1]) == (1, 15)
        assert records[0][2].text() == "ros2"
        assert records[-1][2].take("I") == zlib.crc32(self.data[:records[-1][0]])
        for place, operation, fields in records[1:-1]:
            if operation == 3:
                schema = fields.take("H")
                self.schemas[schema] = (fields.text(), fields.text(), fields.raw(fields.take("I")).decode())
            elif operation == 4:
                channel, schema = fields.take("H"), fields.take("H")
                self.channels[channel] = (fields.text(), schema, fields.text())
            elif operation == 6:
                self.read_chunk(place, fields)
            elif operation == 7:
                chunk = self.chunks[max(self.chunks)]
                channel = fields.take("H")
                chunk["indexes"][channel] = place
                for time, offset in fields.pairs("Q", "Q"):
                    assert chunk["messages"].pop(offset) == (channel, time)
            elif operation == 12:
                name = fields.text()
                self.metadata[name] = (place, dict(fields.pairs("s", "s")))
        assert not any(chunk["messages"] for chunk in self.chunks.values()), "a message without an index"

    def read_chunk(self, place, fields):
        begin, end, size, crc, method = [fields.take(form) for form in "QQQI"] + [fields.text()]
        compressed = fields.raw(fields.take("Q"))
        assert method == "zstd"
        content = decompressed(compressed, size)
        assert zlib.crc32(content) == crc
        self.chunks[place] = {"times": (begin, end), "sizes": (len(compressed), size), "indexes": {}, "messages": {},
                              "length": 9 + len(fields.data)}
        for offset, operation, message in records_of(content, 0, size):
            assert operation == 5
            channel, _, time, published = [message.take(form) for form in "HIQQ"]
            assert begin <= time <= end and published == time
            self.chunks[place]["messages"][offset] = (channel, time)
            self.messages.append((channel, time, message.data[message.place:]))

    def read_summary(self, place):
        chunks = []
        for _, operation, fields in records_of(self.data, place, len(self.data) - 37):
            if operation == 8:
                times, where, length = (fields.take("Q"), fields.take("Q")), fields.take("Q"), fields.take("Q")
                indexes, _, _ = dict(fields.pairs("H", "Q")), fields.take("Q"), fields.text()
                chunk = self.chunks[where]
                assert (times, length, indexes) == (chunk["times"], chunk["length"], chunk["indexes"])
                assert (fields.take("Q"), fields.take("Q")) == chunk["sizes"]
                chunks.append(where)
            elif operation == 11:
                assert [fields.take(form) for form in "QHIIII"] == [
                    len(self.messages), len(self.schemas), len(self.channels), 0, len(self.metadata), len(self.chunks)]
                times = [time for _, time, _ in self.messages]
                assert (fields.take("Q"), fields.take("Q")) == (min(times), max(times))
                for channel, count in fields.pairs("H", "Q"):
                    assert count == sum(own == channel for own, _, _ in self.messages)
            elif operation == 13:
                where, _ = fields.take("Q"), fields.take("Q")
                assert where == self.metadata[fields.text()][0]
        assert chunks == list(self.chunks)

    def on(self, topic):
        """Decoded messages of a topic."""
        (channel,) = [number for number, (name, _, _) in self.channels.items() if name == topic]
        name, encoding, text = self.schemas[self.channels[channel][1]]
        assert encoding == "ros2msg" and self.channels[channel][2] == "cdr"
        types = types_of(name.replace("/msg/", "/"), text)
        return [Cdr(data).message(types, name.replace("/msg/", "/"))
                for own, _, data in self.messages if own == channel]


def types_of(name, text):
    """Fields (type, name) by type, from concatenated definitions."""
    types = {}
    for part in text.split("=" * 80 + "\nMSG: "):
        lines = part.splitlines()
        if types:
            name = lines.pop(0)
        types[name] = [tuple(line.split()[:2]) for line in lines if line]
    return types


class Cdr:
    FORMS = {"int32": "i", "uint32": "I", "uint8": "B", "bool": "?", "float32": "f", "float64": "d"}

    def __init__(self, data):
        assert data[:4] == b"\0\1\0\0"
        self.data, self.place = data[4:], 0

    def numbers(self, kind, count):
        form = self.FORMS[kind]
        size = struct.calcsize(form)
        self.place += -self.place % size if count else 0
        values = struct.unpack_from(f"<{count}{form}", self.data, self.place)
        self.place += count * size
        return values

    def value(self, types, kind):
        if kind.endswith("]"):
            kind, count = kind[:-1].split("[")
            count = int(count) if count else self.numbers("uint32", 1)[0]
            if kind in self.FORMS:
                return self.numbers(kind, count)
            return [self.value(types, kind) for _ in range(count)]
        if kind == "string":
            (length,) = self.numbers("uint32", 1)
            self.place += length
            text = self.data[self.place - length:self.place]
            assert text[-1] == 0
            return text[:-1].decode()
        if kind in self.FORMS:
            return self.numbers(kind, 1)[0]
        return {name: self.value(types, of) for of, name in types[kind]}

    def message(self, types, kind):
        message = self.value(types, kind)
        assert self.place == len(self.data), f"{kind}: {len(self.data) - self.place} bytes left"
        return message
