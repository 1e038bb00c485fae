"""dataclasses_from_schema.py OUT.py FACETMILL...: writes the typed classes of the reports, from facetmill's own schemas."""

import json
import keyword
import subprocess
import sys

HEAD = '''"""The reports of facetmill {version} as dataclasses. Generated from `facetmill schema`; do not edit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Union

from ._decode import Record
'''


def class_name(words: str) -> str:
    return ''.join(w[:1].upper() + w[1:] for w in words.replace('.', '_').replace('-', '_').split('_'))


class Writer:
    """The classes of one schema; a nested object gets the name of its parent and its field."""

    def __init__(self, prefix: str, schema: dict) -> None:
        self.prefix, self.schema, self.text, self.done = prefix, schema, [], set()
        for name in schema.get('$defs', {}):
            self.class_of(prefix + class_name(name), schema['$defs'][name])

    def type_of(self, schema: dict, name: str) -> str:
        if '$ref' in schema:
            return self.prefix + class_name(schema['$ref'].rsplit('/', 1)[-1])
        if 'anyOf' in schema:
            some = [s for s in schema['anyOf'] if s.get('type') != 'null']
            kinds = list(dict.fromkeys(self.type_of(s, name) for s in some))
            inner = kinds[0] if len(kinds) == 1 else f'Union[{", ".join(kinds)}]'
            return f'Optional[{inner}]' if len(some) < len(schema['anyOf']) else inner
        kind = schema.get('type')
        if kind == 'object' and 'properties' in schema and all(map(str.isidentifier, schema['properties'])):
            self.class_of(name, schema)
            return name
        if kind == 'object':
            return 'Dict[str, Any]'
        if kind == 'array':
            return f'List[{self.type_of(schema.get("items", {}), name)}]'
        if 'enum' in schema or 'const' in schema:
            value = schema.get('const', schema.get('enum', [''])[0])
            return {bool: 'bool', int: 'int', float: 'float', str: 'str'}.get(type(value), 'Any')
        return {'integer': 'int', 'number': 'float', 'string': 'str', 'boolean': 'bool'}.get(kind, 'Any')

    def class_of(self, name: str, schema: dict) -> None:
        if name in self.done:
            return
        self.done.add(name)
        if 'properties' not in schema:
            self.text.append(f'\n\n{name} = {self.type_of(schema, name + "Value")}\n')
            return
        required, fields = set(schema.get('required', [])), []
        for key, value in schema['properties'].items():
            kind = self.type_of(value, name + class_name(key))
            if key == 'result' and 'allOf' in schema:
                kind = 'Any'
            if key not in required and not kind.startswith('Optional'):
                kind = f'Optional[{kind}]'
            about = value.get('description')
            field = key + '_' if keyword.iskeyword(key) else key
            fields.append((key not in required, f'    {field}: {kind}' + ('' if key in required else ' = None'), about))
        lines = [f'\n\n@dataclass(frozen=True)\nclass {name}(Record):']
        if schema.get('description'):
            lines.append(f'    """{schema["description"]}"""\n')
        for _, line, about in sorted(fields, key=lambda f: f[0]):
            lines += [line] + ([f'    """{about}"""'] if about else [])
        if not fields:
            lines.append('    pass')
        self.text.append('\n'.join(lines) + '\n')

    def results(self) -> str:
        """Which class the result of each stage has: RESULTS."""
        rows = [f'    "{name[7:]}": {self.prefix}{class_name(name)},'
                for name in self.schema.get('$defs', {}) if name.startswith('result.')]
        return '\n\nRESULTS = {\n' + '\n'.join(rows) + '\n}\n'


def main() -> None:
    out, *program = sys.argv[1:]

    def ask(*arguments: str) -> dict:
        return json.loads(subprocess.run([*program, *arguments], check=True, capture_output=True).stdout)

    text = HEAD.format(version=ask('--version', '--json')['version'])
    for kind, prefix in (('report', ''), ('batch', 'Batch'), ('info', 'Info'), ('diff', 'Diff')):
        schema = ask('schema', kind)
        writer = Writer(prefix, schema)
        writer.class_of({'report': 'Report'}.get(kind, prefix), schema)
        text += ''.join(writer.text) + (writer.results() if kind == 'report' else '')
    with open(out, 'w', encoding='utf8') as file:
        file.write(text)


main()
