import { settings } from '../state/settings';
import { en, type TextKey } from './en';
import { pt } from './pt';

export type { TextKey } from './en';

const texts = { en, pt };
export type Language = keyof typeof texts;
export const languages: readonly Language[] = ['en', 'pt'];
/** Each language's own name for itself. */
export const languageNames: Record<Language, string> = { en: 'English', pt: 'Português' };

/** The words in the language that is set; a component that calls this follows the setting. */
export function t(key: TextKey): string {
  return texts[settings.language.value][key];
}
