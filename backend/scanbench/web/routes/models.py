"""REST: what is known about PLC models."""

from fastapi import APIRouter

from scanbench.web import messages as wire
from scanbench.web import translate
from scanbench.web.reach import Bench

router = APIRouter(prefix="/api/models", tags=["models"])


@router.get("")
async def on_models(bench: Bench) -> list[wire.ModelSummary]:
    """Every model."""
    return [translate.model_summary(model) for model in bench.models.values()]


@router.get("/{name}")
async def on_model(bench: Bench, name: str) -> wire.ModelInfo:
    """Memory areas and error catalogue of a model."""
    return translate.model_info(bench.projects.model(name))
