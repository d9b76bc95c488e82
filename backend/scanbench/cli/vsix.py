"""The extension for VS Code as one file: what `vsce package` makes, without Node. Nothing but the standard library: the build uses it."""

import io
import json
import zipfile
from collections.abc import Mapping
from html import escape
from pathlib import Path

from scanbench import __version__

NAME = f"scanbench-{__version__}.vsix"

EPOCH = (1980, 1, 1, 0, 0, 0)
"""Of every file in it: the same extension gives the same bytes."""
_TYPES = {
    ".json": "application/json", ".js": "application/javascript", ".md": "text/markdown", ".txt": "text/plain",
    ".vsixmanifest": "text/xml",
}  # fmt: skip


def pack(folder: Path) -> bytes:
    """The `.vsix` of the extension in `folder`: its `package.json`, and the files that this lists."""
    package = json.loads((folder / "package.json").read_text("utf-8"))
    names = ["package.json", "README.md", *package["files"]]
    files = {"extension.vsixmanifest": _manifest(package).encode(), "[Content_Types].xml": _types().encode()}
    files |= {f"extension/{_inside(name)}": (folder / name).read_bytes() for name in names}
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, EPOCH)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return content.getvalue()


def _inside(name: str) -> str:
    """A file without an ending has no content type."""
    return name if Path(name).suffix else f"{name}.txt"


def _types() -> str:
    defaults = "".join(f'<Default Extension="{ending}" ContentType="{type}"/>' for ending, type in _TYPES.items())
    space = "http://schemas.openxmlformats.org/package/2006/content-types"
    return f'<?xml version="1.0" encoding="utf-8"?>\n<Types xmlns="{space}">{defaults}</Types>\n'


def _manifest(package: Mapping[str, object]) -> str:
    def told(key: str) -> str:
        return escape(str(package[key]))

    engines, categories = package["engines"], package["categories"]
    assert isinstance(engines, dict)
    assert isinstance(categories, list)
    return f"""<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="{told("name")}" Version="{told("version")}" Publisher="{told("publisher")}"/>
    <DisplayName>{told("displayName")}</DisplayName>
    <Description xml:space="preserve">{told("description")}</Description>
    <Categories>{escape(",".join(map(str, categories)))}</Categories>
    <Properties><Property Id="Microsoft.VisualStudio.Code.Engine" Value="{escape(str(engines["vscode"]))}"/></Properties>
    <License>extension/LICENSE.txt</License>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/README.md" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.License" Path="extension/LICENSE.txt" Addressable="true"/>
  </Assets>
</PackageManifest>
"""
