"""JSON with // comments, as specs and cases may have them."""
import json
import re


def without_comments(text):
    return re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*', lambda m: m[1] or "", text)


def read_json(path):
    return json.loads(without_comments(path.read_text()))
