"""What is true of STATUSTEXT pieces, written and read."""

from hypothesis import given
from hypothesis import strategies as st

from gcs.status_lines import StatusLines
from sitl.events import StatusText
from sitl.services.codec import Codec
from sitl.services.status_text import status_text_messages

LINES = (
    st.text(st.characters(min_codepoint=32, max_codepoint=126), min_size=1, max_size=230).map(str.strip).filter(bool)
)


@given(st.lists(LINES, min_size=1, max_size=4))
def test_lines_of_any_length_come_together_again(lines: list[str]) -> None:
    writer, reader, assembled = Codec(1, 1), Codec(255, 190), StatusLines()
    out = []
    for number, line in enumerate(lines, 1):
        for piece in status_text_messages(StatusText(4, line), number):
            for message in reader.feed(writer.pack(piece)):
                out += assembled.feed(message)
    assert out == lines


def test_a_line_that_lost_its_end_is_shown_when_the_next_one_comes() -> None:
    assembled = StatusLines()
    first = status_text_messages(StatusText(4, "a" * 60), 1)[0]
    wire = [Codec(255, 190).feed(Codec(1, 1).pack(m))[0] for m in (first, *status_text_messages(StatusText(4, "b"), 2))]
    assert [line for message in wire for line in assembled.feed(message)] == ["a" * 50, "b"]
