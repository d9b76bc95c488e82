import { exampleFor } from "../../../logic/errors/userErrors";
import { addError, addExample } from "../../../store/errors/userErrors";
import { useBench } from "../../../store/plc/bench";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";

/** None yet: what user-defined errors are for, what they consist of, and an example to begin with. */
export function NoErrors() {
  const model = useBench((bench) => bench.model);
  const example = exampleFor(model);
  return (
    <Empty
      title={t("usererrors.empty.title")}
      about={t("usererrors.empty.about")}
      ways={[
        {
          icon: "generated",
          strong: t("usererrors.empty.flag"),
          rest: t("usererrors.empty.flag.rest", { flag: example.flag }),
        },
        { icon: "fatal", strong: t("usererrors.empty.code"), rest: t("usererrors.empty.code.rest") },
      ]}
    >
      <h3 className="small">{t("usererrors.empty.example")}</h3>
      <div className="offersrow">
        <button type="button" className="tr offer" onClick={() => addExample(example)}>
          <Icon name="plus" />
          <span>{t("usererrors.empty.example.name")}</span>
          <span className="meta mono">
            {example.code} · {example.flag}
          </span>
        </button>
      </div>
      <button type="button" className="btn sm" onClick={addError}>
        <Icon name="plus" small />
        {t("usererrors.add")}
      </button>
    </Empty>
  );
}
