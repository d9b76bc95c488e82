/** The REST routes of a project's folder under git. */
import { json } from "./rest";
import type { CommitText, GitCommit, GitStatus, NewCommit } from "./types";

const at = (project: number) => `/projects/${project}/git`;

export const git = {
  status: (project: number) => json<GitStatus>("GET", at(project)),
  /** Makes the folder. */
  begin: (project: number) => json<GitStatus>("POST", at(project)),
  commits: (project: number) => json<GitCommit[]>("GET", `${at(project)}/commits`),
  commit: (project: number, commit: string) => json<CommitText>("GET", `${at(project)}/commits/${commit}`),
  /** Commits what is saved. */
  commitNow: (project: number, commit: NewCommit) => json<GitCommit>("POST", `${at(project)}/commits`, commit),
};
