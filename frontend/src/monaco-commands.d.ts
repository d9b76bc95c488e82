/** Runs a command with several arguments, which the editor's own functions cannot. Its packages have no types for their parts. */
declare module "monaco-editor/platform/commands/common/commands" {
  export const ICommandService: {
    (...of: unknown[]): void;
    readonly type: { executeCommand<T>(id: string, ...what: unknown[]): Promise<T | undefined> };
  };
}
