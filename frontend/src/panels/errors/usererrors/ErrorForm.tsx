import { groupText, problemsOf, readGroup, textOf, withText } from "../../../logic/errors/userErrors";
import { deleteError, duplicateError, edit, rename, useUserErrors } from "../../../store/errors/userErrors";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import type { UserError, UserProblem } from "../../../wire/types";
import { Details } from "./Details";
import { Choose, Entry, Words } from "./Entry";

interface Props {
  index: number;
  error: UserError;
  problems: readonly UserProblem[];
}

/** One error as a form; problems are shown below their fields during typing. */
export function ErrorForm({ index, error, problems }: Props) {
  const found = problemsOf(problems, index);
  const name = textOf(error.texts, "en", "name");
  const change = (changed: Partial<UserError>) => edit(index, changed);
  const say = (language: string, what: "name" | "description") => (text: string) =>
    change({ texts: withText(error.texts, language, what, text) });
  return (
    <form
      className="ueform scroll"
      aria-label={t("usererrors.form", { name: name || t("usererrors.noname") })}
      onSubmit={(event) => event.preventDefault()}
    >
      <div className="uehead">
        <h3 className="grow cut">{name || t("usererrors.noname")}</h3>
        <button type="button" className="btn sm" onClick={() => duplicateError(index)}>
          {t("usererrors.duplicate")}
        </button>
        <button type="button" className="btn sm" onClick={() => deleteError(index)}>
          <Icon name="trash" small />
          {t("usererrors.delete")}
        </button>
      </div>
      {found.has("") && (
        <p className="hint bad" role="alert">
          <Icon name="error" small />
          {found.get("")}
        </p>
      )}
      <div className="uefields ue2">
        <Entry
          label={t("usererrors.name")}
          value={name}
          onChange={(text) => rename(index, text)}
          wrong={found.get("texts.0.name")}
        />
        <Entry
          label={t("usererrors.name.ja")}
          value={textOf(error.texts, "ja", "name")}
          onChange={say("ja", "name")}
          language="ja"
        />
        <Entry
          label={t("usererrors.id")}
          value={error.id}
          mono
          onChange={(id) => change({ id })}
          wrong={found.get("id")}
        />
        <GroupEntry error={error} onChange={(group) => change({ group })} wrong={found.get("group")} />
      </div>
      <Effect error={error} found={found} change={change} />
      <div className="uefields ue2">
        <Words
          label={t("usererrors.description")}
          value={textOf(error.texts, "en", "description")}
          onChange={say("en", "description")}
        />
        <Words
          label={t("usererrors.description.ja")}
          value={textOf(error.texts, "ja", "description")}
          onChange={say("ja", "description")}
          language="ja"
        />
      </div>
      <Details details={error.details} found={found} onChange={(details) => change({ details })} />
      {error.also.length > 0 && (
        <p className="hint">
          {t("usererrors.also", { addresses: error.also.map(({ address }) => address).join(", ") })}
        </p>
      )}
    </form>
  );
}

interface EffectProps {
  error: UserError;
  found: ReadonlyMap<string, string>;
  change: (changed: Partial<UserError>) => void;
}

/** The effect of the error on the PLC. */
function Effect({ error, found, change }: EffectProps) {
  return (
    <div className="uefields ue4">
      <Entry
        label={t("usererrors.flag")}
        value={error.flag}
        mono
        onChange={(flag) => change({ flag })}
        wrong={found.get("flag")}
      />
      <Entry
        label={t("usererrors.code")}
        value={error.code}
        mono
        onChange={(code) => change({ code })}
        wrong={found.get("code")}
      />
      <Choose
        label={t("usererrors.severity")}
        value={error.severity}
        options={{ nonfatal: t("errors.nonfatal"), fatal: t("errors.fatal") }}
        onChange={(severity) => change({ severity, ...(severity === "fatal" ? {} : { memory: "" }) })}
        wrong={found.get("severity")}
      />
      <Entry
        label={t("usererrors.priority")}
        value={error.priority}
        mono
        title={t("usererrors.priority.hint")}
        onChange={(priority) => change({ priority })}
        wrong={found.get("priority")}
      />
      <Choose
        label={t("usererrors.cause")}
        value={error.cause || "passing"}
        options={{ passing: t("usererrors.cause.passing"), lasting: t("usererrors.cause.lasting") }}
        onChange={(cause) => change({ cause: cause === "passing" ? "" : cause })}
        wrong={found.get("cause")}
        wide
      />
      {error.severity === "fatal" && (
        <Choose
          label={t("usererrors.memory")}
          value={error.memory || "model"}
          options={{ model: t("usererrors.memory.model"), keep: t("usererrors.memory.keep") }}
          onChange={(memory) => change({ memory: memory === "model" ? "" : memory })}
          wrong={found.get("memory")}
          wide
        />
      )}
    </div>
  );
}

/** The group; the existing groups are offered. */
function GroupEntry(props: { error: UserError; onChange: (group: string[]) => void; wrong: string | undefined }) {
  const { error, onChange, wrong } = props;
  const errors = useUserErrors((state) => state.errors);
  const known = [...new Set(errors.map((other) => groupText(other.group)))].filter(Boolean);
  return (
    <Entry
      label={t("usererrors.group")}
      value={groupText(error.group)}
      placeholder={t("usererrors.group.hint")}
      offers={known}
      onLeave={(text) => onChange(readGroup(text))}
      wrong={wrong}
    />
  );
}
