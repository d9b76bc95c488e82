"""The files of the program that runs."""

from scanbench.web.dap import shapes
from scanbench.web.dap.debuggee import Debuggee
from scanbench.web.dap.shapes import Body
from scanbench.wire.refused import Refused


async def on_loaded_sources(plc: Debuggee, _args: shapes.Nothing) -> Body:
    """All of them."""
    return {"sources": [plc.paths.source(file) for file in sorted(plc.session.instance.sources.files)]}


async def on_source(plc: Debuggee, args: shapes.SourceText) -> Body:
    """The text as it was built."""
    source = args.source
    if args.source_reference and not source.source_reference:
        source = source.model_copy(update={"source_reference": args.source_reference})
    text = plc.session.instance.sources.files.get(plc.paths.file(source))
    if text is None:
        raise Refused("the program was changed meanwhile: ask for the sources again")
    return {"content": text, "mimeType": "text/x-iec61131-st"}
