"""What can be said of the metadata without their contexts, as JSON schemas."""

ENTITY = {
    "type": "object",
    "required": ["@id", "@type"],
    "additionalProperties": {
        "anyOf": [
            {"type": "string"},
            {"$ref": "#/$defs/link"},
            {"type": "array", "items": {"anyOf": [{"type": "string"}, {"$ref": "#/$defs/link"}]}},
        ]
    },
}
CRATE = {
    "type": "object",
    "required": ["@context", "@graph"],
    "properties": {"@graph": {"type": "array", "items": ENTITY}},
    "$defs": {
        "link": {
            "type": "object",
            "required": ["@id"],
            "properties": {"@id": {"type": "string"}},
            "additionalProperties": False,
        }
    },
}
AGENT = {
    "type": "object",
    "required": ["type", "name"],
    "properties": {"type": {"enum": ["Person", "Organization"]}},
}
CODEMETA = {
    "type": "object",
    "required": ["name", "version", "description", "license", "author", "referencePublication"],
    "properties": {
        "@context": {"const": "https://w3id.org/codemeta/3.0"},
        "type": {"const": "SoftwareSourceCode"},
        "version": {"pattern": r"^\d+\.\d+\.\d+$"},
        "datePublished": {"pattern": r"^\d{4}-\d\d-\d\d$"},
        "license": {"pattern": "^https://spdx.org/licenses/"},
        "author": {"type": "array", "minItems": 1, "items": AGENT},
        "softwareRequirements": {
            "type": "array",
            "minItems": 1,
            "items": {"required": ["type", "name", "version", "identifier"]},
        },
        "referencePublication": {"required": ["id", "type", "name", "author"]},
    },
}
