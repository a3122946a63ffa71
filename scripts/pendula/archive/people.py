"""Authors and papers of CITATION.cff in the words of schema.org."""


def agent(author: dict) -> dict:
    """Return a person, or an organization where the author has but one name."""
    if "name" in author:
        return {"@type": "Organization", "name": author["name"], **_identity(author)}
    given, family = author["given-names"], author["family-names"]
    names = {"name": f"{given} {family}", "givenName": given, "familyName": family}
    return {"@type": "Person", **names, **_identity(author)}


def article(paper: dict) -> dict:
    """Return a paper without its authors, identified by its DOI."""
    found = [entry["value"] for entry in paper.get("identifiers", ())]
    place = f"{paper['journal']} {paper['volume']}, {paper['start']}"
    return {
        "@id": f"https://doi.org/{paper['doi']}",
        "@type": "ScholarlyArticle",
        "name": paper["title"],
        "datePublished": str(paper["year"]),
        "identifier": [f"https://doi.org/{paper['doi']}", *found],
        "isPartOf": place,
    }


def _identity(author: dict) -> dict:
    known = author.get("orcid") or author.get("website")
    return {"@id": known} if known else {}
