"""A question before what cannot be undone: nobody does it by a slip of the hand."""

from collections.abc import Callable

import viser


def ask(gui: viser.GuiApi, question: str, explained: str, yes: str, no: str, act: Callable[[], None]) -> None:
    """Ask in a window of the page, and act if the answer is yes."""
    modal = gui.add_modal(question)
    with modal:
        gui.add_markdown(explained)
        agree = gui.add_button(yes, color="red")
        refuse = gui.add_button(no)

    def agreed() -> None:
        modal.close()
        act()

    agree.on_click(lambda _: agreed())
    refuse.on_click(lambda _: modal.close())
