"""The tags of a page, for tests of links, pictures and nesting."""

from html.parser import HTMLParser

VOID = {"area", "br", "col", "hr", "img", "input", "link", "meta", "rect", "line"}


class Tags(HTMLParser):
    """Collects tags with their attributes, identifiers, and faults of nesting."""

    def __init__(self, text: str):
        super().__init__()
        self.tags, self.open, self.faults = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        if tag == "a" and "a" in self.open:
            self.faults.append(f"a link within a link: {attrs}")
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if tag not in VOID and self.open.pop() != tag:
            self.faults.append(f"</{tag}> closes another")

    def all(self, tag: str) -> list[dict]:
        """Return the attributes of each tag with this name."""
        return [attributes for name, attributes in self.tags if name == tag]

    @property
    def ids(self) -> list[str]:
        """All identifiers of the page: the possible targets of its internal links."""
        return [attributes["id"] for _, attributes in self.tags if "id" in attributes]
